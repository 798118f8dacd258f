#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// How a shape is painted. Colors as in CSS; "none" paints nothing.
struct Paint {
    std::string_view fill = "none";
    std::string_view stroke = "none";
    double width = 1;               ///< of the stroke [pixels]
    std::string_view dashes = "";   ///< as "4 3"; empty: solid
    double opacity = 1;
};

enum class Anchor { start, middle, end };

/// A text label; its size is the document's unless given.
struct Label {
    Anchor anchor = Anchor::start;
    double size = 12;   ///< [pixels]
    std::string_view color = "#222222";
    bool bold = false;
    double rotation = 0;   ///< clockwise about the anchor [degrees]
};

/// About how wide a text is drawn [pixels], by the letters of DejaVu Sans, the font of the documents.
double text_width(std::string_view content, Label const& = {});

/// The text in lines no wider than `most` [pixels], broken at spaces, and within words only where these are wider.
std::vector<std::string> broken_into_lines(std::string_view content, double most, Label const& = {});

struct SvgPoint {
    double x = 0, y = 0;
};

/// An SVG document that grows, shape over shape; lengths in pixels from the top left corner, two decimals kept.
///
/// Coordinates must be finite. All text is escaped, and bytes that XML or UTF-8 forbid become '?', so that a name from
/// a file cannot break the picture.
class SvgDocument {
public:
    /// White, of the given size; `title` is what screen readers and tool tips say.
    SvgDocument(double width, double height, std::string_view title);

    void line(SvgPoint from, SvgPoint to, Paint const&);
    void polyline(std::span<SvgPoint const>, Paint const&);
    void polygon(std::span<SvgPoint const>, Paint const&);
    void circle(SvgPoint center, double radius, Paint const&);
    void rect(SvgPoint corner, double width, double height, Paint const&);
    void text(SvgPoint at, std::string_view content, Label const& = {});
    /// Lines `height` pixels below each other, the first at `at`.
    void text(SvgPoint at, std::span<std::string const> lines, double height, Label const& = {});
    /// What is drawn until end_group is shown only within the rectangle.
    void begin_clip(SvgPoint corner, double width, double height);
    void end_group();
    /// A piece of SVG in units of its own, `scale` pixels each, from `corner` on. Precondition: it is well-formed.
    void embed(SvgPoint corner, double scale, std::string_view element);

    std::string finish() &&;

private:
    std::string text_;
    int clips_ = 0;
};

/// Why librsvg cannot read the text as an SVG document, or "" if it can.
std::string why_no_svg(std::string_view text);

/// PNG bytes of an SVG document, `scale` pixels per user unit, fewer where an edge would be longer than 16384 pixels
/// (librsvg behind this door). Throws Error.
std::string render_png(std::string_view svg, double scale = 1.5);

}   // namespace lore
