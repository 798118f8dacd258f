#include <lore/knowledge/index.h>

namespace lore {

std::unique_ptr<FeatureIndex> make_flann_index(KnowledgeConfig const& config, int, int) { return make_scan_index(config); }

} // namespace lore
