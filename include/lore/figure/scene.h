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

/// A scene_svg that is no SVG element is left out: a picture without it is better than none.
Scene scene_of(World const&);

}   // namespace lore
