#pragma once

#include <string>

namespace lore {

class World;

/// What a picture shows of a world behind the paths; lengths in [u], y grows downwards.
struct Scene {
    float width = 1, height = 1;
    std::string svg;   ///< one SVG element in units of positions, as World::scene_svg gives it; "": nothing
    friend bool operator==(Scene const&, Scene const&) = default;
};

/// What a world or a file gives as Scene::svg, or "" where it is no SVG: a picture without it is better than none.
std::string svg_or_nothing(std::string svg);

/// With svg_or_nothing of the world's scene_svg.
Scene scene_of(World const&);

}   // namespace lore
