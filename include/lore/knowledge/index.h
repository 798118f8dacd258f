#pragma once

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
    /// Precondition: FeatureIndex::set_values was called.
    virtual Match match_above(Window const& window, double least) {
        (void)least;
        return match(window);
    }
    /// False if no window with these bits, whatever its values, matches a feature worth more than `least`.
    /// Precondition as above.
    virtual bool may_match_above(std::span<std::uint16_t const> bits, double least) {
        (void)bits;
        (void)least;
        return true;
    }
};

/// The windows of features, one after the other; the only copy while a knowledge base is being built.
struct FeatureWindows {
    std::vector<std::uint16_t> bits;   ///< [feature][step][word], the bits of binary channels alone
    std::vector<float> values;         ///< [feature][step][continuous channel]

    void add(Channels const&, Window const&);
    Window window(int feature, KnowledgeConfig const&) const;   ///< valid until the next add
};

/// Finds the nearest feature of a growing set of windows, which it copies. Reading it (by searches, also from several
/// threads) and adding to it exclude each other.
class FeatureIndex {
public:
    virtual ~FeatureIndex() = default;
    /// Feature number = order of addition. Precondition: values were not set yet.
    virtual void add(Window const&) = 0;
    virtual int size() const = 0;
    /// Hands over the windows of all features; nothing but destruction may follow.
    virtual FeatureWindows release() = 0;
    virtual std::unique_ptr<FeatureSearch> search() const = 0;
    /// What each feature is worth, once all are added; lets match_above pass over the others.
    virtual void set_values(std::span<double const>) {}
};

/// The definition: every feature is compared.
std::unique_ptr<FeatureIndex> make_scan_index(KnowledgeConfig const&);
/// Exact and fast: bounds by bits, then by summaries, then the exact distance (docs/design/performance.md).
std::unique_ptr<FeatureIndex> make_exact_index(KnowledgeConfig const&);
/// FLANN's KDTree forest with a fixed number of checks: approximate, and not repeatable from process to process.
std::unique_ptr<FeatureIndex> make_flann_index(KnowledgeConfig const&, int trees = 4, int checks = usual_checks);
std::unique_ptr<FeatureIndex> make_index(IndexChoice, KnowledgeConfig const&);
/// A final set: answers as an index that was given the base's features one by one and then their values, and is made
/// in less time and memory. Reads the base's windows where they are: the base must outlive it. Has none to release.
std::unique_ptr<FeatureIndex> make_final_exact_index(KnowledgeBase const&);
std::unique_ptr<FeatureIndex> make_final_index(IndexChoice, KnowledgeBase const&);

}   // namespace lore
