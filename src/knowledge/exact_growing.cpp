#include "exact_hash.h"
#include "exact_kernel.h"
#include "exact_shape.h"
#include "keyed_set.h"
#include "window_store.h"

#include <lore/knowledge/index.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

// exact_shape.h has the bounds. A set that grows, which is when a knowledge base is built, is searched by what the
// search has found: buckets are visited from the smallest to the largest, those of halves before those of blocks. The
// more have been seen, the more bits must differ in a feature that has not (KeyedSearch): a match at a smaller distance
// ends the search, and these bits leave less for the continuous channels. Bounds 1 and 3 shrink with the distance, too.
// Most of a bucket is passed over by keys (bound 3 and the number of set bits), many of them by groups; of the others,
// the pattern is looked at, and if that does not rule them out, the codes (bound 4). Mostly one feature is left, and
// its window is not even read, unless it may lie beyond the threshold or a new feature may be nearer.

namespace lore {

namespace {

using exact::Finalist;
using exact::Question;

/// What one thread needs to search for windows that are taken up.
struct Worker {
    std::array<exact::SearchMemory, exact::searches_together> memories;
    exact::RecentMatches recent = exact::no_recent_matches();   ///< among the features that were known before
    std::vector<float> copy;
};

class ExactGrowingIndex : public GrowingIndex {
public:
    ExactGrowingIndex(KnowledgeConfig const& config, std::string const& folder)
        : shape_(exact::shape_of(config)), kernel_(exact::kernel_of(active_isa())), set_(shape_), described_(shape_),
          windows_(config, folder), fresh_(shape_) {
        described_.resize(1);
    }

    void add(Window const& window) override {
        described_.describe(0, kernel_, window);
        set_.add(described_[0]);
        windows_.add(window);
    }
    std::vector<int> take_up(std::span<Window const>, Crew&) override;
    int size() const override { return static_cast<int>(set_.size()); }
    WindowArrays release() override { return windows_.release(); }
    std::unique_ptr<FeatureSearch> search() const override;

    exact::Shape const& shape() const { return shape_; }
    exact::Kernel const& kernel() const { return kernel_; }
    exact::KeyedSet const& set() const { return set_; }
    WindowStore const& windows() const { return windows_; }

private:
    exact::Shape shape_;
    exact::Kernel kernel_;
    exact::KeyedSet set_;
    exact::Descriptions described_;   ///< of the windows that are added or taken up
    WindowStore windows_;
    exact::KeyedSet fresh_;         ///< of take_up: of each call, but for its memory
    std::vector<Worker> workers_;   ///< of take_up, one a thread
};

/// The finalists among the features of a set; `recent`: of searches in this set, or null.
std::span<Finalist const> closest(ExactGrowingIndex const& index, exact::KeyedSet const& set, Question const& question,
                                  exact::Wanted wanted, exact::SearchMemory& memory, exact::RecentMatches* recent) {
    exact::Search search{question, wanted, memory.room_for(index.shape(), set.largest_bucket(), recent), 0};
    index.kernel().closest(set.view(), &search, 1);
    return memory.finalists(search);
}

class ExactGrowingSearch : public FeatureSearch {
public:
    explicit ExactGrowingSearch(ExactGrowingIndex const& index) : index_(index), asked_(index.shape()) {
        asked_.resize(1);
    }

    Match match(Window const& window) override {
        assert(
            window.bits.size() == static_cast<std::size_t>(index_.shape().window_length * index_.shape().step_words) &&
            window.values.size() == static_cast<std::size_t>(index_.shape().window_length * index_.shape().continuous));
        asked_.describe(0, index_.kernel(), window);
        auto const finalists = closest(index_, index_.set(), asked_[0],
                                       {index_.shape().squared_threshold, exact::all_features}, memory_, &recent_);
        return nearest_of(finalists, index_.kernel(), index_.shape(), window.values.data(),
                          [&](int feature) { return index_.windows().values(feature, copy_); });
    }

private:
    ExactGrowingIndex const& index_;
    exact::Descriptions asked_;
    exact::SearchMemory memory_;
    exact::RecentMatches recent_ = exact::no_recent_matches();
    std::vector<float> copy_;
};

std::unique_ptr<FeatureSearch> ExactGrowingIndex::search() const { return std::make_unique<ExactGrowingSearch>(*this); }

/// A window's match among the features that were there before its batch.
struct KnownMatch {
    Finalist among{-1, 0, 0, 0};   ///< feature -1: none
    bool exactly = false;          ///< `least` and `most` are its squared distance
    bool found() const { return among.feature >= 0; }
};

/// Windows that are taken up together. The long part, finding the match of each among the features known before,
/// changes nothing and is shared among threads. Of those that have none, each becomes a feature or matches one that has
/// just become one: these few are gone through in order, and make a small set of their own. Then threads share the
/// question whether a window that has a match lies nearer to a feature of that set, among those that were there in its
/// turn.
class Batch {
public:
    /// What it works with must outlive it: one worker a thread, memory for what is asked, and an empty set for its
    /// features.
    Batch(ExactGrowingIndex const& index, std::span<Window const> windows, Crew& crew, std::span<Worker> workers,
          exact::Descriptions& asked, exact::KeyedSet& fresh)
        : index_(index), windows_(windows), crew_(crew), workers_(workers), asked_(asked), known_(windows.size()),
          numbers_(windows.size()), fresh_(fresh) {
        asked_.resize(windows.size());
    }

    /// Finds out what follows; once.
    void match();
    /// Of the features of all windows.
    std::vector<int> const& numbers() const { return numbers_; }
    /// The windows that became features, in order.
    std::vector<std::size_t> const& origins() const { return origins_; }
    Question described(std::size_t window) const { return asked_[window]; }

private:
    /// Calls work(worker, first, last) for ranges of indices that cover all windows.
    template <class Work>
    void share_out(Work const& work) {
        constexpr std::size_t share = 512;   // many, because neighbors are alike
        crew_.share(windows_.size(), share, [&](std::size_t thread, std::size_t first, std::size_t last) {
            work(workers_[thread], first, last);
        });
    }
    std::vector<std::size_t> alike_together() const;
    void match_among_known(Worker&, std::span<std::size_t const> windows);
    void take_known(Worker&, std::size_t window, std::span<Finalist const>);
    void add_fresh(std::size_t window);
    void match_among_fresh(Worker&, std::size_t window);
    Match nearest_fresh(Worker&, std::size_t window, float bound, std::size_t features) const;
    int number_of_fresh(std::size_t feature) const { return index_.size() + static_cast<int>(feature); }
    /// Finalists of the set that was there before.
    template <class Finalists>
    Match nearest_known(Worker& worker, std::size_t window, Finalists const& finalists) const {
        return nearest_of(finalists, index_.kernel(), index_.shape(), windows_[window].values.data(),
                          [&](int feature) { return index_.windows().values(feature, worker.copy); });
    }

    ExactGrowingIndex const& index_;
    std::span<Window const> windows_;
    Crew& crew_;
    std::span<Worker> workers_;
    exact::Descriptions& asked_;
    std::vector<KnownMatch> known_;
    std::vector<int> numbers_;
    exact::KeyedSet& fresh_;
    std::vector<std::size_t> origins_;   ///< [fresh feature]
};

void Batch::match() {
    share_out([&](Worker&, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) asked_.describe(i, index_.kernel(), windows_[i]);
    });
    std::vector<std::size_t> const order = alike_together();
    share_out([&](Worker& worker, std::size_t first, std::size_t last) {
        match_among_known(worker, std::span{order}.subspan(first, last - first));
    });
    for (std::size_t i = 0; i < windows_.size(); ++i)
        if (!known_[i].found()) add_fresh(i);
    share_out([&](Worker& worker, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (known_[i].found()) match_among_fresh(worker, i);
    });
}

constexpr int ranks = 4;
/// The highest bits of a key's sums, those of highest rank first: keys that are alike have numbers that are alike.
std::uint64_t interleaved(exact::Key const& key) {
    std::uint64_t number = 0;
    for (int rank = 7; rank > 7 - ranks; --rank)
        for (std::uint8_t const sum : key.sums) number = number << 1 | (sum >> rank & 1);
    return number;
}

/// Indices of windows in an order that puts those with the same bits next to each other, and of these those whose
/// values are alike: one after the other they read the same memory, and the match of one is a good first guess for the
/// next.
std::vector<std::size_t> Batch::alike_together() const {
    std::vector<std::pair<std::uint64_t, std::size_t>> by_likeness;
    by_likeness.reserve(windows_.size());
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        Question const asked = asked_[i];
        constexpr int of_values = ranks * exact::key_size;
        std::uint64_t const bits = exact::hash_slot(asked.words, nullptr, index_.shape().words, 64 - of_values);
        by_likeness.emplace_back(bits << of_values | interleaved(asked.key), i);
    }
    std::sort(by_likeness.begin(), by_likeness.end());
    std::vector<std::size_t> order(windows_.size());
    std::transform(by_likeness.begin(), by_likeness.end(), order.begin(), [](auto const& one) { return one.second; });
    return order;
}

/// Of windows in an order in which neighbors are alike: those that are searched for together are far from each other,
/// so that the match of a window can be the first guess for its neighbor.
void Batch::match_among_known(Worker& worker, std::span<std::size_t const> windows) {
    exact::KeyedView const view = index_.set().view();
    std::size_t const length = (windows.size() + exact::searches_together - 1) / exact::searches_together;
    for (std::size_t place = 0; place < length; ++place) {
        std::array<exact::Search, exact::searches_together> searches{};
        int count = 0;
        for (std::size_t at = place; at < windows.size(); at += length, ++count) {
            auto const i = static_cast<std::size_t>(count);
            searches[i] = {asked_[windows[at]],
                           {index_.shape().squared_threshold, exact::all_features},
                           worker.memories[i].room_for(index_.shape(), index_.set().largest_bucket(), &worker.recent),
                           0};
        }
        index_.kernel().closest(view, searches.data(), count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            take_known(worker, windows[place + i * length], worker.memories[i].finalists(searches[i]));
    }
}

void Batch::take_known(Worker& worker, std::size_t window, std::span<Finalist const> finalists) {
    if (finalists.size() == 1 && finalists[0].most < index_.shape().squared_threshold) {   // the nearest, however far
        known_[window] = {finalists[0], false};
        return;
    }
    if (Match const match = nearest_known(worker, window, finalists); match.found())
        known_[window] = {{match.feature, 0, match.squared_distance, match.squared_distance}, true};
}

void Batch::add_fresh(std::size_t window) {
    Match const match = nearest_fresh(workers_[0], window, index_.shape().squared_threshold, origins_.size());
    numbers_[window] = number_of_fresh(match.found() ? static_cast<std::size_t>(match.feature) : origins_.size());
    if (match.found()) return;
    fresh_.add(asked_[window]);
    origins_.push_back(window);
}

void Batch::match_among_fresh(Worker& worker, std::size_t window) {
    KnownMatch& known = known_[window];
    numbers_[window] = known.among.feature;
    auto const there =
        static_cast<std::size_t>(std::lower_bound(origins_.begin(), origins_.end(), window) - origins_.begin());
    Match const match = nearest_fresh(worker, window, known.among.most, there);
    if (!match.found()) return;
    if (match.squared_distance >= known.among.least && !known.exactly) {
        Match const exact = nearest_known(worker, window, std::span{&known.among, 1});
        known.among.least = known.among.most = exact.squared_distance;
    }
    if (match.squared_distance < known.among.least)   // of two at one distance the older one is the match
        numbers_[window] = number_of_fresh(static_cast<std::size_t>(match.feature));
}

/// The nearest of the first `features` fresh ones; any, or none, if it is beyond the bound.
Match Batch::nearest_fresh(Worker& worker, std::size_t window, float bound, std::size_t features) const {
    if (features == 0) return {};
    auto const finalists = closest(index_, fresh_, asked_[window], {bound, static_cast<std::int32_t>(features)},
                                   worker.memories[0], nullptr);
    return nearest_of(finalists, index_.kernel(), index_.shape(), windows_[window].values.data(),
                      [&](int feature) { return windows_[origins_[static_cast<std::size_t>(feature)]].values.data(); });
}

std::vector<int> ExactGrowingIndex::take_up(std::span<Window const> windows, Crew& crew) {
    if (crew.threads() == 1) return GrowingIndex::take_up(windows, crew);   // nothing to share
    workers_.resize(static_cast<std::size_t>(crew.threads()));
    fresh_.clear();
    Batch batch{*this, windows, crew, workers_, described_, fresh_};
    batch.match();
    std::vector<Question> fresh;
    for (std::size_t const window : batch.origins()) fresh.push_back(batch.described(window));
    set_.add(fresh, crew, [&] {
        for (std::size_t const window : batch.origins()) windows_.add(windows[window]);
    });
    return batch.numbers();
}

}   // namespace

std::unique_ptr<GrowingIndex> make_exact_index(KnowledgeConfig const& config, std::string const& folder) {
    return std::make_unique<ExactGrowingIndex>(config, folder);
}

}   // namespace lore
