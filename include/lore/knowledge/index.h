#pragma once

#include <lore/knowledge/knowledge_base.h>

#include <memory>
#include <string_view>

namespace lore {

struct Match {
    int   feature = -1;            ///< -1: no feature within the threshold
    float squared_distance = 0;    ///< to that feature; infinity if none
    bool found() const { return feature >= 0; }
};

enum class IndexKind : std::uint8_t { exact, flann };
std::string_view name(IndexKind);
IndexKind index_kind(std::string_view name);   ///< throws UsageError

/// Finds the nearest feature of a growing set of windows. Copies what it needs.
class FeatureIndex {
public:
    virtual ~FeatureIndex() = default;
    /// Feature number = order of addition.
    virtual void add(Window const&) = 0;
    virtual int size() const = 0;
    /// The nearest feature if it lies nearer than the threshold (strict; ties: the lowest number).
    virtual Match match(Window const&) const = 0;
};

/// The definition: every feature is compared.
std::unique_ptr<FeatureIndex> make_scan_index(KnowledgeConfig const&);
/// Exact and fast: bounds by bits, then by summaries, then the exact distance (docs/performance.md).
std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const&);
/// FLANN's KDTree forest with a fixed number of checks: approximate, and not repeatable from process to process.
std::unique_ptr<FeatureIndex> make_flann_index(KnowledgeConfig const&, int trees = 4, int checks = 128);
std::unique_ptr<FeatureIndex> make_index(IndexKind, KnowledgeConfig const&);

} // namespace lore
