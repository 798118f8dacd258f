#include <lore/figure/scene.h>

#include <lore/figure/svg.h>
#include <lore/world/world.h>

#include <fmt/format.h>

namespace lore {

Scene scene_of(World const& world) {
    WorldFacts const& facts = world.facts();
    std::string svg = world.scene_svg();
    if (!why_no_svg(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\">{}</svg>", svg)).empty()) svg.clear();
    return {facts.width, facts.height, std::move(svg)};
}

}   // namespace lore
