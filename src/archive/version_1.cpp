#include "version_1.h"

#include "boost_types.h"

#include <lore/collectball/channels.h>
#include <lore/collectball/collectball.h>

#include <array>

namespace lore {

WorldRecord const& world_of_version_1() {
    static WorldRecord const world{"", "", "balls", collectball_channels(), 0, 0, 0, "", 0, ""};
    return world;
}

void get_descriptors_of_version_1(InArchive& archive, Descriptors& descriptors) {
    std::vector<Point> positions;
    get_blob(archive, positions, most_balls);
    for (Point const& position : positions)
        descriptors.outcome.insert(descriptors.outcome.end(), {position.x, position.y});
    get_field(archive, descriptors.channel_bits);
    get_field(archive, descriptors.path);
    std::array<double, channel_count> entropies;
    get_field(archive, entropies);
    descriptors.entropies.assign(entropies.begin(), entropies.end());
}

}   // namespace lore
