#pragma once

#include <lore/world/facts.h>

#include <memory>
#include <span>
#include <vector>

namespace lore {

/// The interface between a world and its controllers: sensors, then effectors, all values in [0, 1] (paper, "Robot,
/// environment and goal-oriented fitness"). Their order is that of the network's inputs and outputs, of a window's
/// channels and of the columns of traces.
///
/// A value: cheap to copy, equal to another of the same names and kinds. Channels are numbered from 0, sensors first.
class Channels {
public:
    Channels() = default;   ///< none
    /// Precondition: within the bounds of facts.h.
    Channels(std::vector<ChannelInfo> const& sensors, std::vector<ChannelInfo> const& effectors);
    explicit Channels(WorldFacts const& facts) : Channels(facts.sensors, facts.effectors) {}

    int count() const { return sensors_ + effectors_; }
    int sensors() const { return sensors_; }
    int effectors() const { return effectors_; }
    ChannelInfo const& operator[](int channel) const { return lists_->all[static_cast<std::size_t>(channel)]; }
    std::span<ChannelInfo const> all() const { return lists_ ? lists_->all : std::span<ChannelInfo const>{}; }

    /// The channels of each kind, in increasing order: a continuous one has any value between 0 and 1, a binary one 0
    /// or 1.
    std::span<int const> binary() const { return lists_ ? lists_->binary : std::span<int const>{}; }
    std::span<int const> continuous() const { return lists_ ? lists_->continuous : std::span<int const>{}; }
    int binary_count() const { return binary_; }
    int continuous_count() const { return count() - binary_; }
    bool is_binary(int channel) const { return (*this)[channel].binary; }

    /// 16-bit words that hold one bit of every channel: binary channels first, then the continuous ones, as
    /// Trace::channel_bits has them.
    int words() const { return (count() + 15) / 16; }

    friend bool operator==(Channels const&, Channels const&);

private:
    struct Lists {
        std::vector<ChannelInfo> all;
        std::vector<int> binary, continuous;
    };
    int sensors_ = 0, effectors_ = 0, binary_ = 0;
    std::shared_ptr<Lists const> lists_;
};

inline constexpr int most_channels = most_sensors + most_effectors;

/// Why controllers and knowledge made for `theirs` do not fit `ours`, with the first channel that differs; "" if they
/// do.
std::string why_misfit(Channels const& theirs, Channels const& ours);

}   // namespace lore
