#include "process_world.h"

#include "refusal.h"
#include "single_life.h"

#include <lore/world/values.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lore {

namespace {

/// Of the frame that holds the facts: the scene, 80 channels and some numbers [bytes].
constexpr std::size_t most_of_facts = std::size_t{longest_scene} + 16384;

constexpr std::string_view remedy = "Mend it; docs/manual/worlds.md has the rules.";

/// A number of the frame as facts have it; one that does not fit breaks a bound in any case.
int count_of(std::uint32_t told) {
    return static_cast<int>(std::min<std::uint32_t>(told, std::numeric_limits<int>::max()));
}

void refuse_count(char const* name, std::uint32_t count, std::uint32_t most, std::string const& called) {
    if (count < 1 || count > most)
        refuse_world(called, fmt::format("its number of {} is {}, which is outside 1 .. {}", name, count, most),
                     remedy);
}

std::vector<ChannelInfo> read_channels(FrameReader& reader, std::uint32_t count, char const* kind,
                                       std::string const& called) {
    std::vector<ChannelInfo> channels;
    for (std::uint32_t c = 0; c < count; ++c) {
        std::uint32_t const binary = reader.number();
        if (binary > 1)
            refuse_world(called, fmt::format("binary of {} {} is {}, and is 0 or 1", kind, c, binary), remedy);
        channels.push_back({reader.text(), binary == 1});
    }
    return channels;
}

/// The facts behind the version. Throws Error.
WorldFacts read_facts(FrameReader& reader, std::string const& called) {
    WorldFacts facts;
    std::uint32_t const sensors = reader.number(), effectors = reader.number();
    refuse_count("sensors", sensors, most_sensors, called);
    refuse_count("effectors", effectors, most_effectors, called);
    facts.outcome_size = count_of(reader.number());
    facts.max_batch = count_of(reader.number());
    facts.width = reader.real();
    facts.height = reader.real();
    facts.name = reader.text();
    facts.task = reader.text();
    facts.reward_unit = reader.text();
    facts.sensors = read_channels(reader, sensors, "sensor", called);
    facts.effectors = read_channels(reader, effectors, "effector", called);
    return facts;
}

std::string at_step(std::int64_t step) { return fmt::format("at step {}", step); }

class ProcessLives final : public Lives {
public:
    ProcessLives(ProcessWorld const& world, int count)
        : world_(world), link_(world.link()), count_(static_cast<std::size_t>(count)), batch_(world.next_batch()),
          sensors_(world.facts().sensors.size() * count_), x_(count_), y_(count_), rewards_(count_), over_(count_),
          before_(count_) {
        FrameWriter question{"begin", batch_};
        question.number(static_cast<std::uint32_t>(count));
        FrameReader answer{ask(std::move(question), "senses", size_of_senses())};
        read_senses(answer);
        check_senses();
    }
    ProcessLives(ProcessLives const&) = delete;
    ProcessLives& operator=(ProcessLives const&) = delete;
    ~ProcessLives() override { link_.tell(FrameWriter{"end", batch_}); }

    int count() const override { return static_cast<int>(count_); }

    void sense(std::span<float> sensors, std::span<float> x, std::span<float> y) const override {
        std::ranges::copy(sensors_, sensors.begin());
        std::ranges::copy(x_, x.begin());
        std::ranges::copy(y_, y.begin());
    }

    void act(std::span<float const> effectors, std::span<float> rewards, std::span<unsigned char> over) override {
        assert(effectors.size() == world_.facts().effectors.size() * count_);
        FrameWriter question{"act", batch_};
        question.floats(effectors);
        FrameReader answer{ask(std::move(question), "results", size_of_senses() + 5 * count_)};
        read_senses(answer);
        answer.floats(rewards_);
        answer.bytes(over_);
        refuse_values(link_.called(), steps_, why_results_are_wrong(rewards_, over_, before_));
        ++steps_;
        check_senses();
        before_ = over_;
        std::ranges::copy(rewards_, rewards.begin());
        std::ranges::copy(over_, over.begin());
    }

    void outcome(std::span<float> values) const override {
        if (values.empty()) return;
        FrameReader answer{ask(FrameWriter{"outcome", batch_}, "outcomes", 4 * values.size())};
        answer.floats(values);
        refuse_values(link_.called(), steps_, why_outcomes_are_wrong(world_.facts(), values, count()));
    }

private:
    std::size_t size_of_senses() const { return 4 * (sensors_.size() + 2 * count_); }

    /// Asks what has an answer of `size` bytes.
    std::span<char const> ask(FrameWriter&& question, std::string_view expected, std::size_t size) const {
        auto const answer = link_.ask(std::move(question), expected, size, at_step(steps_));
        if (answer.size() != size)
            link_.give_up(fmt::format("{} sent nonsense {}", link_.called(), at_step(steps_)),
                          fmt::format("its answer '{}' for {} lives has {} bytes, and not {}", expected, count_,
                                      answer.size(), size),
                          "Mend it; docs/manual/formats.md has the frames.");
        return answer;
    }
    void read_senses(FrameReader& answer) {
        answer.floats(sensors_);
        answer.floats(x_);
        answer.floats(y_);
    }
    void check_senses() const {
        refuse_values(link_.called(), steps_, why_senses_are_wrong(world_.facts(), sensors_, x_, y_));
    }

    ProcessWorld const& world_;
    ProcessLink& link_;
    std::size_t count_;
    std::uint32_t batch_;
    std::int64_t steps_ = 0;   ///< done
    std::vector<float> sensors_, x_, y_, rewards_;
    std::vector<unsigned char> over_, before_;
};

}   // namespace

ProcessWorld::ProcessWorld(WorldProcess const& process, std::string const& settings) : link_(process) {
    FrameWriter question{"open", 0};
    question.number(process_protocol_version).text(settings);
    FrameReader answer{link_.ask(std::move(question), "facts", most_of_facts, "at its start")};
    std::string const called = link_.called();
    if (std::uint32_t const version = answer.number(); version != process_protocol_version)
        refuse_world(called,
                     fmt::format("it speaks version {} of the frames, and this Lore version {}", version,
                                 process_protocol_version),
                     "Take the lore_world.py of this Lore.");
    facts_ = read_facts(answer, called);
    scene_ = answer.text();
    if (!answer.exact()) refuse_world(called, "the frame of its facts is too short or too long", remedy);
    if (std::string const why = why_invalid(facts_); !why.empty()) refuse_world(called, why, remedy);
    if (scene_.size() > longest_scene)
        refuse_world(called, fmt::format("its scene has more than {} bytes", longest_scene), "Draw less.");
    link_.call(fmt::format("{} from {}", title(facts_), fmt::join(process.command, " ")));
}

std::unique_ptr<Life> ProcessWorld::begin() const { return std::make_unique<SingleLife>(begin_lives(1)); }

std::unique_ptr<Lives> ProcessWorld::begin_lives(int count) const {
    assert(count >= 1 && count <= facts_.max_batch);
    return std::make_unique<ProcessLives>(*this, count);
}

std::unique_ptr<World> start_world(WorldProcess const& process, std::string const& settings) {
    return std::make_unique<ProcessWorld>(process, settings);
}

}   // namespace lore
