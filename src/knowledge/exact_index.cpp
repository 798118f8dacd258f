#include <lore/knowledge/index.h>

namespace lore {

std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const& config) { return make_scan_index(config); }

} // namespace lore
