#include <lore/evolution/lineage.h>

#include <algorithm>
#include <unordered_set>

namespace lore {

std::vector<Birth const*> lineage_of(Birth const& individual) {
    std::vector<Birth const*> lineage;
    for (Birth const* birth = &individual; birth != nullptr; birth = birth->parent.get()) lineage.push_back(birth);
    return lineage;
}

std::vector<Birth const*> ancestors_of(std::span<Individual const> members) {
    std::unordered_set<Birth const*> known;
    for (Individual const& member : members)
        for (Birth const* birth = member.birth.get(); birth != nullptr && known.insert(birth).second;)
            birth = birth->parent.get();
    std::vector<Birth const*> ancestors(known.begin(), known.end());
    std::sort(ancestors.begin(), ancestors.end(), [](Birth const* a, Birth const* b) { return a->id < b->id; });
    return ancestors;
}

}   // namespace lore
