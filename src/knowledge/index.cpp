#include <lore/knowledge/index.h>

#include <lore/core/names.h>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr auto index_names = names_for<IndexKind>("exact", "flann");

/// Keeps all features and compares every one.
class ScanIndex : public GrowingIndex {
public:
    explicit ScanIndex(KnowledgeConfig const& config) : config_(config) {}

    void add(Window const& window) override {
        features_.add(config_.channels, window);
        ++size_;
    }
    int size() const override { return size_; }
    WindowArrays release() override { return features_.release(); }
    std::unique_ptr<FeatureSearch> search() const override;

    Match match(Window const& window) const {
        Match nearest;
        for (int feature = 0; feature < size_; ++feature) {
            float const distance = squared_distance(config_.channels, window, features_.window(feature, config_));
            if (distance < nearest.squared_distance && distance < config_.squared_threshold())
                nearest = {feature, distance};
        }
        return nearest;
    }

private:
    KnowledgeConfig config_;
    FeatureWindows features_;
    int size_ = 0;
};

class ScanSearch : public FeatureSearch {
public:
    explicit ScanSearch(ScanIndex const& index) : index_(index) {}
    Match match(Window const& window) override { return index_.match(window); }

private:
    ScanIndex const& index_;
};

std::unique_ptr<FeatureSearch> ScanIndex::search() const { return std::make_unique<ScanSearch>(*this); }

}   // namespace

void FeatureWindows::add(Channels const& channels, Window const& window) {
    append_binary_bits(channels, window, bits);
    values.insert(values.end(), window.values.begin(), window.values.end());
}

Window FeatureWindows::window(int feature, KnowledgeConfig const& config) const {
    auto const length = static_cast<std::size_t>(config.window_length), number = static_cast<std::size_t>(feature);
    std::size_t const words = length * static_cast<std::size_t>(config.channels.words()),
                      floats = length * static_cast<std::size_t>(config.channels.continuous_count());
    return {{bits.data() + number * words, words}, {values.data() + number * floats, floats}};
}

WindowArrays FeatureWindows::release() {
    auto const kept = std::make_shared<FeatureWindows const>(std::move(*this));
    return {kept->bits, kept->values, kept};
}

std::vector<int> GrowingIndex::take_up(std::span<Window const> windows, Crew&) {
    std::vector<int> numbers;
    numbers.reserve(windows.size());
    if (!search_) search_ = search();
    for (Window const& window : windows) {
        Match const match = search_->match(window);
        numbers.push_back(match.found() ? match.feature : size());
        if (!match.found()) add(window);
    }
    return numbers;
}

std::string_view name(IndexKind kind) { return index_names[kind]; }

IndexKind index_kind(std::string_view name) {
    if (auto const kind = index_names.find(name)) return *kind;
    throw UsageError(fmt::format("there is no index '{}'", name), "known are exact and flann", "Choose one of them.");
}

std::unique_ptr<GrowingIndex> make_scan_index(KnowledgeConfig const& config) {
    return std::make_unique<ScanIndex>(config);
}

std::string text(IndexChoice const& choice) {
    bool const usual = choice.kind == IndexKind::exact || choice.checks == usual_checks;
    return usual ? std::string{name(choice.kind)} : fmt::format("{} with {} checks", name(choice.kind), choice.checks);
}

std::unique_ptr<GrowingIndex> make_index(IndexChoice choice, KnowledgeConfig const& config, std::string const& folder) {
    return choice.kind == IndexKind::exact ? make_exact_index(config, folder)
                                           : make_flann_index(config, 4, choice.checks);
}

std::unique_ptr<FeatureIndex> make_final_index(IndexChoice choice, KnowledgeBase const& base) {
    if (choice.kind == IndexKind::exact) return make_final_exact_index(base);
    auto index = make_index(choice, base.config());
    for (int feature = 0; feature < base.size(); ++feature) index->add(base.window(feature));
    return index;
}

}   // namespace lore
