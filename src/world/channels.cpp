#include <lore/world/channels.h>

#include <fmt/format.h>

namespace lore {

Channels::Channels(std::vector<ChannelInfo> const& sensors, std::vector<ChannelInfo> const& effectors)
    : sensors_(static_cast<int>(sensors.size())), effectors_(static_cast<int>(effectors.size())) {
    auto lists = std::make_shared<Lists>();
    lists->all = sensors;
    lists->all.insert(lists->all.end(), effectors.begin(), effectors.end());
    for (int channel = 0; channel < count(); ++channel)
        (lists->all[static_cast<std::size_t>(channel)].binary ? lists->binary : lists->continuous).push_back(channel);
    binary_ = static_cast<int>(lists->binary.size());
    lists_ = std::move(lists);
}

bool operator==(Channels const& a, Channels const& b) {
    if (a.sensors_ != b.sensors_ || a.effectors_ != b.effectors_) return false;
    return a.lists_ == b.lists_ || a.count() == 0 || a.lists_->all == b.lists_->all;
}

std::string why_misfit(Channels const& theirs, Channels const& ours) {
    if (theirs == ours) return "";
    if (theirs.sensors() != ours.sensors() || theirs.effectors() != ours.effectors())
        return fmt::format("made for {} sensors and {} effectors, not for {} and {}", theirs.sensors(),
                           theirs.effectors(), ours.sensors(), ours.effectors());
    int channel = 0;
    while (theirs[channel] == ours[channel]) ++channel;
    auto const text = [](ChannelInfo const& info) {
        return fmt::format("{} '{}'", info.binary ? "binary" : "continuous", info.name);
    };
    return fmt::format("made for another world: its channel {} is {}, not {}", channel, text(theirs[channel]),
                       text(ours[channel]));
}

}   // namespace lore
