#pragma once

#include <lore/core/crew.h>
#include <lore/knowledge/knowledge_base.h>

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

struct Match {
    int feature = -1;                                                  ///< -1: no feature within the threshold
    float squared_distance = std::numeric_limits<float>::infinity();   ///< to that feature; infinity if none
    bool found() const { return feature >= 0; }
    friend bool operator==(Match const&, Match const&) = default;
};

enum class IndexKind : std::uint8_t { exact, flann };
std::string_view name(IndexKind);
IndexKind index_kind(std::string_view name);   ///< throws UsageError

/// Leaves of its trees that a search by FLANN looks at: more find more of the matches, and take longer. FLANN's own
/// default is 32.
inline constexpr int usual_checks = 128;
/// Which index, and how hard it looks.
struct IndexChoice {
    IndexChoice(IndexKind wanted, int of_flann = usual_checks) : kind(wanted), checks(of_flann) {}
    IndexKind kind;
    int checks;   ///< of flann; at least 1
};
/// "exact", "flann", "flann with 64 checks": Provenance::index.
std::string text(IndexChoice const&);

/// One user's way of asking an index: owns the scratch memory and the caches that make repeated questions cheap.
///
/// For one thread at a time (make one each), valid as long as its index, also while that index grows.
class FeatureSearch {
public:
    virtual ~FeatureSearch() = default;
    /// The nearest feature if it lies nearer than the threshold (strict; ties: the lowest number).
    virtual Match match(Window const&) = 0;
    /// match(), where only a feature worth more than `least` is of interest: anything else may be reported as none.
    virtual Match match_above(Window const& window, double least) {
        (void)least;
        return match(window);
    }
    /// False if no window with these bits, whatever its values, matches a feature worth more than `least`.
    virtual bool may_match_above(std::span<std::uint16_t const> bits, double least) {
        (void)bits;
        (void)least;
        return true;
    }
};

/// A set of features that can be searched, also by several threads at once.
class FeatureIndex {
public:
    virtual ~FeatureIndex() = default;
    virtual int size() const = 0;
    virtual std::unique_ptr<FeatureSearch> search() const = 0;
};

/// The windows of features as a knowledge base keeps them; `keep_alive` owns the memory behind the spans.
struct WindowArrays {
    std::span<std::uint16_t const> bits;   ///< [feature][step][word], the bits of binary channels alone
    std::span<float const> values;         ///< [feature][step][continuous channel]
    std::shared_ptr<void const> keep_alive;
};

/// The windows of features in memory, one after the other.
struct FeatureWindows {
    std::vector<std::uint16_t> bits;   ///< as WindowArrays, as is what follows
    std::vector<float> values;

    void add(Channels const&, Window const&);
    Window window(int feature, KnowledgeConfig const&) const;   ///< valid until the next add
    WindowArrays release();                                     ///< leaves nothing behind
};

/// A set that grows, and copies the windows that it is given. Searching it and adding to it exclude each other.
class GrowingIndex : public FeatureIndex {
public:
    /// Feature number = order of addition.
    virtual void add(Window const&) = 0;
    /// Takes up windows in order: the number of each one's match, or of the feature that it becomes because it has
    /// none. The numbers do not depend on the crew, which shares the work where that is possible.
    virtual std::vector<int> take_up(std::span<Window const>, Crew&);
    /// Hands over the windows of all features; nothing but destruction may follow.
    virtual WindowArrays release() = 0;

private:
    std::unique_ptr<FeatureSearch> search_;   ///< of take_up, one window after the other
};

/// The definition: every feature is compared.
std::unique_ptr<GrowingIndex> make_scan_index(KnowledgeConfig const&);
/// Exact and fast: bounds by bits, then by summaries, then by rounded values, then the exact distance
/// (docs/design/performance.md). `folder`: where a file without a name keeps the windows, which are most of its memory;
/// empty: in memory. Throws Error: that file cannot be written.
std::unique_ptr<GrowingIndex> make_exact_index(KnowledgeConfig const&, std::string const& folder = {});
/// FLANN's KDTree forest with a fixed number of checks: approximate, and not repeatable from process to process.
std::unique_ptr<GrowingIndex> make_flann_index(KnowledgeConfig const&, int trees = 4, int checks = usual_checks);
std::unique_ptr<GrowingIndex> make_index(IndexChoice, KnowledgeConfig const&, std::string const& folder = {});
/// A final set, which knows what its features are worth: answers as a growing index that was given the base's windows,
/// and may pass over those worth too little. Reads the base's windows where they are: the base must outlive it.
std::unique_ptr<FeatureIndex> make_final_exact_index(KnowledgeBase const&);
std::unique_ptr<FeatureIndex> make_final_index(IndexChoice, KnowledgeBase const&);

}   // namespace lore
