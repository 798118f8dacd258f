#include <lore/figure/svg.h>

#include <lore/core/error.h>

#include <gtest/gtest.h>

namespace lore {
namespace {

bool contains(std::string const& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// Width and height in a PNG's first chunk.
std::pair<int, int> png_size(std::string const& png) {
    auto const number = [&](std::size_t at) {
        int value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(png.at(i));
        return value;
    };
    return {number(16), number(20)};
}

TEST(SvgDocument, writes_its_shapes_in_order) {
    SvgDocument svg{100, 50, "a picture"};
    svg.line({0, 0}, {10, 10.126}, {.stroke = "#000000", .width = 0.5, .dashes = "4 3"});
    svg.circle({20, 20}, 5, {.fill = "red"});
    std::string const text = std::move(svg).finish();
    EXPECT_TRUE(contains(text, "width=\"100\" height=\"50\""));
    std::size_t const line = text.find("<line x1=\"0\" y1=\"0\" x2=\"10\" y2=\"10.13\" fill=\"none\" "
                                       "stroke=\"#000000\" stroke-width=\"0.5\" stroke-dasharray=\"4 3\"/>");
    std::size_t const circle = text.find("<circle cx=\"20\" cy=\"20\" r=\"5\" fill=\"red\"/>");
    ASSERT_NE(line, std::string::npos) << text;
    ASSERT_NE(circle, std::string::npos) << text;
    EXPECT_LT(line, circle);
}

TEST(SvgDocument, escapes_text) {
    SvgDocument svg{10, 10, "a < b & \"c\""};
    svg.text({0, 0}, "<script>\x01\xff caf\xc3\xa9");
    std::string const text = std::move(svg).finish();
    EXPECT_TRUE(contains(text, "<title>a &lt; b &amp; &quot;c&quot;</title>"));
    EXPECT_TRUE(contains(text, "&lt;script&gt;?? caf\xc3\xa9</text>")) << text;
}

TEST(TextWidth, goes_by_letters_not_bytes) {
    EXPECT_NEAR(text_width("WWW"), 35.6, 0.1);
    EXPECT_NEAR(text_width("iii"), 10.0, 0.1);
    EXPECT_NEAR(text_width("caf\xc3\xa9"), text_width("cafe"), 1);
    EXPECT_NEAR(text_width("\xe8\xbf\xb7\xe5\xae\xab", {.size = 10}), 20, 0.1) << "a labyrinth";
    EXPECT_GT(text_width("maze", {.bold = true}), text_width("maze"));
    EXPECT_EQ(text_width(""), 0);
}

TEST(TextWidth, says_where_a_text_is_broken_into_lines) {
    using Lines = std::vector<std::string>;
    EXPECT_EQ(broken_into_lines("a maze", 100), Lines{"a maze"});
    EXPECT_EQ(broken_into_lines("the hard maze", 60), (Lines{"the hard", "maze"}));
    EXPECT_EQ(broken_into_lines("labyrinth", 30), (Lines{"laby", "rinth"})) << "a word that is wider";
    EXPECT_EQ(broken_into_lines("\xe8\xbf\xb7\xe5\xae\xab", 12), (Lines{"\xe8\xbf\xb7", "\xe5\xae\xab"}));
    EXPECT_EQ(broken_into_lines("WW", 1), (Lines{"W", "W"}));
    EXPECT_EQ(broken_into_lines("", 10), Lines{""});
}

TEST(RenderPng, gives_a_picture_of_the_scaled_size) {
    SvgDocument svg{100, 50, "\xed\xa0\x80 \xf0\x9f\xa4\x96"};   // a surrogate, and a robot
    svg.rect({0, 0}, 100, 50, {.fill = "#ff0000"});
    std::string const png = render_png(std::move(svg).finish(), 2.0);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(png_size(png), (std::pair{200, 100}));
}

TEST(RenderPng, refuses_what_is_no_svg) {
    EXPECT_THROW(render_png("no svg"), Error);
    EXPECT_THROW(render_png(""), Error);
}

TEST(RenderPng, has_fewer_pixels_where_an_edge_would_be_too_long) {
    EXPECT_EQ(png_size(render_png(SvgDocument{20000, 50, "wide"}.finish())), (std::pair{16384, 41}));
    EXPECT_EQ(png_size(render_png(SvgDocument{1, 100, "tall"}.finish(), 1e9)), (std::pair{164, 16384}));
}

}   // namespace
}   // namespace lore
