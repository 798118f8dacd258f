#include <lore/figure/scene.h>

#include <lore/figure/svg.h>
#include <lore/world/world.h>

#include <fmt/format.h>

namespace lore {

std::string svg_or_nothing(std::string svg) {
    if (!why_no_svg(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\">{}</svg>", svg)).empty()) svg.clear();
    return svg;
}

Scene scene_of(World const& world) {
    WorldFacts const& facts = world.facts();
    return {facts.width, facts.height, svg_or_nothing(world.scene_svg())};
}

}   // namespace lore
