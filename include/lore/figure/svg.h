#pragma once

#include <string>
#include <string_view>

namespace lore {

/// PNG bytes of an SVG document, `scale` pixels per user unit (librsvg behind this door). Throws Error.
std::string render_png(std::string_view svg, double scale = 1.5);

} // namespace lore
