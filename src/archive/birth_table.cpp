#include "birth_table.h"

#include <cassert>
#include <cmath>

namespace lore {

namespace {

constexpr std::uint32_t no_parent = UINT32_MAX;
constexpr std::size_t least_bytes_a_birth = 48;   ///< id, parent, reward of 4 bytes, shaping, diversity, two counts

}   // namespace

void put_births(OutArchive& archive, std::vector<Birth const*> const& births) {
    std::uint64_t const count = births.size();
    archive << count;
    for (Birth const* birth : births) {
        std::uint32_t parent = no_parent;
        if (birth->parent != nullptr) {
            parent = static_cast<std::uint32_t>(place_of(births, birth->parent->id));
            assert(parent < births.size() && "an ancestor is missing");
        }
        archive << birth->id << parent;
        put_reward(archive, birth->reward);
        archive << birth->shaping << birth->diversity << birth->genome;
    }
}

std::vector<std::shared_ptr<Birth const>> get_births(InArchive& archive) {
    std::vector<std::shared_ptr<Birth const>> births(get_count(archive, least_bytes_a_birth));
    for (std::size_t i = 0; i < births.size(); ++i) {
        auto birth = std::make_shared<Birth>();
        std::uint32_t parent = 0;
        archive >> birth->id >> parent;
        birth->reward = get_reward(archive);
        archive >> birth->shaping >> birth->diversity >> birth->genome;
        if (parent != no_parent) {
            if (parent >= i || births[parent]->id.generation >= birth->id.generation)
                archive.fail("an individual older than its parent");
            birth->parent = births[parent];
        }
        if (i > 0 && !(births[i - 1]->id < birth->id)) archive.fail("individuals out of the order of birth");
        if (!std::isfinite(birth->reward) || !std::isfinite(birth->shaping) || !std::isfinite(birth->diversity))
            archive.fail("a value that no evaluation gives");
        births[i] = std::move(birth);
    }
    return births;
}

}   // namespace lore
