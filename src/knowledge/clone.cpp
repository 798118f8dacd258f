#include <lore/knowledge/clone.h>

#include "logistic_fit.h"

#include <lore/core/error.h>
#include <lore/core/math.h>
#include <lore/core/random.h>
#include <lore/network/network.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr double bias_factor = 5;   ///< a bias b enters the activation as 5 b
constexpr float neutral_gene = 0.5f;

void check(KnowledgeBase const& base, CloneConfig const& config) {
    auto const refuse = [](std::string const& reason, std::string const& remedy) {
        throw UsageError("cannot clone founders", reason, remedy);
    };
    if (base.size() == 0) refuse("the knowledge base has no features", "Build another.");
    if (config.count < 1) refuse(fmt::format("{} founders were asked for", config.count), "Ask for at least one.");
    int const most_windows = most_cloned_steps / base.config().window_length;
    if (config.windows < 1 || config.windows > most_windows)
        refuse(fmt::format("{} windows a founder were asked for", config.windows),
               fmt::format("Ask for 1 to {}: together they have at most {} steps.", most_windows, most_cloned_steps));
    int const most_neurons = most_cloned_hidden(base.config().channels);
    if (config.hidden < 0 || config.hidden > most_neurons)
        refuse(fmt::format("{} hidden neurons were asked for", config.hidden),
               fmt::format("Ask for 0 to {}.", most_neurons));
}

/// Draws features with probability proportional to their value.
class FeatureLottery {
public:
    explicit FeatureLottery(std::span<double const> values) {
        auto const [low, high] = std::minmax_element(values.begin(), values.end());
        double const shift = std::min(*low, 0.0);
        // Divided by the largest magnitude, so that no sum overflows.
        double const scale = std::max(*high, -shift);
        all_alike_ = *low == *high;
        double sum = 0;
        for (double const value : values) {
            sum += all_alike_ ? 1.0 : value / scale - shift / scale;
            sums_.push_back(sum);
        }
    }
    bool all_alike() const { return all_alike_; }
    int draw(Stream& rng) const {
        double const ticket = rng.uniform() * sums_.back();
        auto const winner = std::upper_bound(sums_.begin(), sums_.end(), ticket);
        // Rounding may give the last ticket, which is the last feature's that has a value.
        auto const last = std::lower_bound(sums_.begin(), sums_.end(), sums_.back());
        return static_cast<int>(std::min(winner, last) - sums_.begin());
    }

private:
    std::vector<double> sums_;   ///< of the values up to and including each
    bool all_alike_ = false;
};

float gene_of(double decoded) {
    return std::clamp(static_cast<float>((decoded - gene_origin) / gene_span), 0.0f, 1.0f);
}

/// Adds a hidden neuron with random input weights, and the bias at which it tells apart what lies to both sides of one
/// step drawn from the windows: with a random bias most neurons would give the same at every step.
void add_hidden_neuron(Genome& genome, KnowledgeBase const& base, std::vector<int> const& features, Stream& rng) {
    Interface const interface = genome.interface;
    auto const neuron = static_cast<NeuronIndex>(genome.first_hidden() + genome.hidden_count());
    int const feature = features[rng.below(static_cast<std::uint32_t>(features.size()))];
    auto const step = rng.below(static_cast<std::uint32_t>(base.config().window_length));
    auto const channels = channels_at(base.config().channels, base.window(feature), step);
    double sum = 0;
    for (std::size_t input = 0; input < interface.inputs; ++input) {
        auto const gene = static_cast<float>(rng.uniform());
        genome.edges.push_back({static_cast<NeuronIndex>(input), neuron, gene});
        sum += static_cast<double>(decode_gene(gene)) * channels[input];
    }
    for (int output = interface.first_output(); output < interface.first_hidden(); ++output)
        genome.edges.push_back({neuron, static_cast<NeuronIndex>(output), neutral_gene});
    genome.biases.push_back(gene_of(sum / bias_factor));
}

/// Every sensor to every effector, then of each hidden neuron its inputs and its outputs. What leads to effectors is
/// neutral.
Genome unfitted(KnowledgeBase const& base, std::vector<int> const& features, int hidden, Stream& rng) {
    Interface const interface { base.config().channels };
    Genome genome{interface};
    for (int input = 0; input < interface.inputs; ++input)
        for (int output = interface.first_output(); output < interface.first_hidden(); ++output)
            genome.edges.push_back({static_cast<NeuronIndex>(input), static_cast<NeuronIndex>(output), neutral_gene});
    genome.biases.assign(interface.outputs, neutral_gene);
    for (int h = 0; h < hidden; ++h) add_hidden_neuron(genome, base, features, rng);
    return genome;
}

/// What an effector's neuron reads at every step of the windows, and what it is to give.
struct Pairs {
    std::size_t width = 0;                      ///< sensors, hidden neurons, and a constant 1
    std::vector<double> inputs;                 ///< [pair][width]
    std::vector<std::vector<double>> targets;   ///< [effector][pair]

    LogisticData of(std::size_t effector) const { return {width, inputs, targets[effector]}; }
};

/// Hidden neurons start at 0 with each window, and are read one tick late, as ever.
Pairs replay(KnowledgeBase const& base, std::vector<int> const& features, Genome const& genome) {
    Network const network = compile(genome);
    auto const hidden = static_cast<std::size_t>(genome.hidden_count());
    auto const length = static_cast<std::size_t>(base.config().window_length);
    std::size_t const inputs = genome.interface.inputs, outputs = genome.interface.outputs;
    std::vector<float> unused(outputs);
    Pairs pairs;
    pairs.width = inputs + hidden + 1;
    pairs.targets.resize(outputs);
    pairs.inputs.reserve(features.size() * length * pairs.width);
    for (int const feature : features) {
        Window const window = base.window(feature);
        NetworkState state;
        for (std::size_t step = 0; step < length; ++step) {
            auto const channels = channels_at(base.config().channels, window, step);
            auto const sensors = std::span{channels}.first(inputs);
            pairs.inputs.insert(pairs.inputs.end(), sensors.begin(), sensors.end());
            pairs.inputs.insert(pairs.inputs.end(), state.hidden.begin(), state.hidden.begin() + genome.hidden_count());
            pairs.inputs.push_back(1.0);
            for (std::size_t e = 0; e < outputs; ++e) pairs.targets[e].push_back(channels[inputs + e]);
            if (hidden > 0) tick(network, sensors, state, unused);
        }
    }
    return pairs;
}

/// Calls f(gene, place among the effector's parameters) for every gene that its neuron has.
void for_each_gene(Genome& genome, std::size_t effector, auto const& f) {
    Interface const interface = genome.interface;
    for (Edge& edge : genome.edges)
        if (edge.target == interface.first_output() + effector)
            f(edge.weight, edge.source < interface.inputs ? edge.source : edge.source - interface.outputs);
}

/// Fits the effector's neuron and returns the parameters that its genes mean.
std::vector<double> fit(Genome& genome, std::size_t effector, LogisticData const& data) {
    constexpr double most = gene_span / 2;
    std::vector<double> bounds(data.width, most);
    bounds.back() = bias_factor * most;
    std::vector<double> theta = fit_logistic(data, bounds);
    for_each_gene(genome, effector, [&](float& gene, int place) {
        double& parameter = theta[static_cast<std::size_t>(place)];
        gene = gene_of(parameter);
        parameter = decode_gene(gene);
    });
    float& bias = genome.biases[effector];
    bias = gene_of(-theta.back() / bias_factor);
    theta.back() = -bias_factor * decode_gene(bias);
    return theta;
}

EffectorFit measure(LogisticData const& data, std::span<double const> theta) {
    return {mean_cross_entropy(data, theta), mean_absolute_error(data, theta)};
}

/// Of the output that is best where inputs are not looked at: the mean of the targets.
EffectorFit measure_constant(std::span<double const> targets) {
    double const mean = std::accumulate(targets.begin(), targets.end(), 0.0) / static_cast<double>(targets.size());
    auto const term = [](double p) { return p > 0 ? -p * math::log(p) : 0.0; };
    double error = 0;
    for (double const target : targets) error += std::abs(target - mean);
    return {term(mean) + term(1 - mean), error / static_cast<double>(targets.size())};
}

void add(EffectorFit& sum, EffectorFit const& one, int count) {
    sum.cross_entropy += one.cross_entropy / count;
    sum.absolute_error += one.absolute_error / count;
}

}   // namespace

int most_cloned_hidden(Channels const& channels) {
    if (channels.count() == 0) return 0;
    int const left = most_edges - channels.sensors() * channels.effectors();
    return std::clamp(left / channels.count(), 0, most_hidden);
}

Clones clone(KnowledgeBase const& base, CloneConfig const& config, std::function<void(int)> const& observer) {
    check(base, config);
    FeatureLottery const lottery{base.values()};
    auto const effectors = static_cast<std::size_t>(base.config().channels.effectors());
    Clones clones;
    clones.fit.resize(effectors);
    clones.constant.resize(effectors);
    clones.all_alike = lottery.all_alike();
    for (int i = 0; i < config.count; ++i) {
        Stream rng{config.seed, Purpose::clone, 0, static_cast<std::uint32_t>(i)};
        std::vector<int> features(static_cast<std::size_t>(config.windows));
        for (int& feature : features) feature = lottery.draw(rng);
        Genome genome = unfitted(base, features, config.hidden, rng);
        Pairs const pairs = replay(base, features, genome);
        for (std::size_t e = 0; e < effectors; ++e) {
            std::vector<double> const theta = fit(genome, e, pairs.of(e));
            add(clones.fit[e], measure(pairs.of(e), theta), config.count);
            add(clones.constant[e], measure_constant(pairs.targets[e]), config.count);
        }
        clones.genomes.push_back(std::move(genome));
        if (observer) observer(i + 1);
    }
    return clones;
}

}   // namespace lore
