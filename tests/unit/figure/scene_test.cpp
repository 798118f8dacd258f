#include <lore/figure/trajectory.h>

#include "support/occurrences.h"

#include <gtest/gtest.h>

#include <limits>

namespace lore {
namespace {

using test::count;

/// 40 steps along the diagonal of a world of 2 x 1, two windows, the second not in the knowledge base.
struct Journey {
    std::vector<Position> positions;
    TrajectoryPicture picture;
    Journey() {
        for (int step = 0; step < 40; ++step) positions.push_back({0.05f * static_cast<float>(step), 0.5f});
        picture.title = "a journey";
        picture.positions = positions;
        picture.lowest = -3;
        picture.highest = -1;
        picture.not_found = std::numeric_limits<double>::quiet_NaN();
        picture.value_label = "value (cos)";
        picture.values = {-1, std::numeric_limits<double>::quiet_NaN()};
    }
};

class World2x1 : public World {
public:
    explicit World2x1(std::string svg) : svg_(std::move(svg)) { facts_.width = 2; }
    WorldFacts const& facts() const override { return facts_; }
    std::unique_ptr<Life> begin() const override { return nullptr; }
    std::string scene_svg() const override { return svg_; }

private:
    std::string svg_;
    WorldFacts facts_;
};

TEST(DrawTrajectory, lies_over_the_scene_of_the_world_with_start_and_end) {
    Journey const journey;
    std::string const svg = draw_trajectory(Scene{2, 1, "<circle cx=\"1\" cy=\"0.5\" r=\"0.25\"/>"}, journey.picture);
    EXPECT_EQ(count(svg, "<g transform=\"translate(66 46) scale(390)\"><circle cx=\"1\" cy=\"0.5\" r=\"0.25\"/></g>"),
              1);
    EXPECT_EQ(count(svg, "<circle cx=\"66\" cy=\"241\" r=\"6\""), 1) << "the start";
    EXPECT_EQ(count(svg, ">start</text>"), 1);
    EXPECT_EQ(count(svg, ">end</text>"), 1);
    EXPECT_EQ(count(svg, "value (cos)"), 2);
    EXPECT_EQ(count(svg, "stroke=\"#08306b\" stroke-width=\"2.8\""), 1) << "the highest value";
    EXPECT_EQ(count(svg, ">not in the knowledge base</text>"), 1) << "without a value of its own";
    EXPECT_EQ(count(svg, "nan"), 0);
    EXPECT_FALSE(render_png(svg).empty());
}

TEST(DrawTrajectory, fits_tall_and_flat_worlds) {
    Journey const journey;
    for (auto const& [width, height] : {std::pair{2.0f, 200.0f}, std::pair{2000.0f, 1.0f}}) {
        std::string const svg = draw_trajectory(Scene{width, height, ""}, journey.picture);
        EXPECT_LT(std::stod(svg.substr(svg.find("height=\"") + 8)), 1600);
        EXPECT_EQ(count(svg, "height=\"-"), 0);
        EXPECT_FALSE(render_png(svg).empty());
    }
}

TEST(DrawTrajectory, breaks_a_long_title_into_lines_above_the_plan) {
    Journey journey;
    journey.picture.title =
        "a journey of a robot that went on and on, through every room and every corridor of the world, "
        "until nobody was there who could have told where it began";
    std::string const svg = draw_trajectory(Scene{2, 1, ""}, journey.picture);
    EXPECT_EQ(count(svg, "font-weight=\"bold\""), 2);
    EXPECT_EQ(count(svg, "<circle cx=\"66\" cy=\"260\" r=\"6\""), 1) << "the start, a line lower";
}

TEST(Scene, leaves_out_what_is_no_svg) {
    EXPECT_EQ(scene_of(World2x1{"<g><rect width=\"1\"/></g>"}), (Scene{2, 1, "<g><rect width=\"1\"/></g>"}));
    EXPECT_EQ(scene_of(World2x1{"<g><rect"}), (Scene{2, 1, ""}));
    EXPECT_EQ(scene_of(World2x1{""}), (Scene{2, 1, ""}));
}

}   // namespace
}   // namespace lore
