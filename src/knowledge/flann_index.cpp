#include <lore/knowledge/index.h>

// The only door to FLANN (1.9): its L2 is the squared distance, its matrices do not own memory, it crashes on an empty
// data set, accepts NaN, and leaves garbage where more neighbors are asked for than there are points. Nothing of that
// passes this file.
#include <flann/flann.hpp>

#include <algorithm>
#include <cassert>

namespace lore {

namespace {

/// The forest is built anew once it has grown by this factor: each point is then rebuilt about once on average, and
/// no tree degenerates. FLANN's own default.
constexpr float rebuild_factor = 2.0f;
constexpr std::size_t rows_per_chunk = 1024;

/// A window as FLANN sees it: all channels of all steps in a row of floats.
void flatten(KnowledgeConfig const& config, Window const& window, float* row) {
    int const words = config.channels.words(), binary = config.channels.binary_count(),
              continuous = config.channels.continuous_count();
    std::uint16_t const* bits = window.bits.data();
    float const* values = window.values.data();
    for (int step = 0; step < config.window_length; ++step, bits += words, values += continuous) {
        for (int bit = 0; bit < binary; ++bit) *row++ = static_cast<float>(bits[bit / 16] >> bit % 16 & 1);
        row = std::copy_n(values, continuous, row);
    }
}

class FlannIndex : public GrowingIndex {
public:
    FlannIndex(KnowledgeConfig const& config, int trees, int checks)
        : config_(config), columns_(static_cast<std::size_t>(config.window_length * config.channels.count())),
          trees_(trees), search_(checks) {
        search_.cores = 1;
    }

    void add(Window const& window) override {
        float* const row = next_row();
        flatten(config_, window, row);
        features_.add(config_.channels, window);
        flann::Matrix<float> const point{row, 1, columns_};
        if (forest_ == nullptr) {
            forest_ = std::make_unique<Forest>(point, flann::KDTreeIndexParams{trees_});
            forest_->buildIndex();
        } else {
            forest_->addPoints(point, rebuild_factor);
        }
        ++size_;
    }
    int size() const override { return size_; }
    WindowArrays release() override { return features_.release(); }
    std::unique_ptr<FeatureSearch> search() const override;

    Match match(Window const& window, std::vector<float>& row) const {
        if (size_ == 0) return {};
        row.resize(columns_);
        flatten(config_, window, row.data());
        int neighbor = -1;
        float flann_distance = 0;
        flann::Matrix<float> const query{row.data(), 1, columns_};
        flann::Matrix<int> neighbors{&neighbor, 1, 1};
        flann::Matrix<float> distances{&flann_distance, 1, 1};
        if (forest_->knnSearch(query, neighbors, distances, 1, search_) < 1 || neighbor < 0 || neighbor >= size_)
            return {};
        // FLANN sums in an order of its own; what counts as a match is decided by our distance.
        float const distance = squared_distance(config_.channels, window, features_.window(neighbor, config_));
        return distance < config_.squared_threshold() ? Match{neighbor, distance} : Match{};
    }

private:
    using Forest = flann::KDTreeIndex<flann::L2<float>>;

    /// The forest keeps pointers to its points, so that rows must never move.
    float* next_row() {
        std::size_t const place = static_cast<std::size_t>(size_) % rows_per_chunk;
        if (place == 0) chunks_.push_back(std::make_unique<float[]>(rows_per_chunk * columns_));
        return chunks_.back().get() + place * columns_;
    }

    KnowledgeConfig config_;
    std::size_t columns_;
    int trees_;
    flann::SearchParams search_;
    std::vector<std::unique_ptr<float[]>> chunks_;
    FeatureWindows features_;
    std::unique_ptr<Forest> forest_;
    int size_ = 0;
};

class FlannSearch : public FeatureSearch {
public:
    explicit FlannSearch(FlannIndex const& index) : index_(index) {}
    Match match(Window const& window) override { return index_.match(window, row_); }

private:
    FlannIndex const& index_;
    std::vector<float> row_;
};

std::unique_ptr<FeatureSearch> FlannIndex::search() const { return std::make_unique<FlannSearch>(*this); }

}   // namespace

std::unique_ptr<GrowingIndex> make_flann_index(KnowledgeConfig const& config, int trees, int checks) {
    assert(trees >= 1 && checks >= 1);
    return std::make_unique<FlannIndex>(config, trees, checks);
}

}   // namespace lore
