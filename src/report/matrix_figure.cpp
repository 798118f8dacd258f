#include "comparison.h"
#include "matrix.h"

#include <lore/figure/svg.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr std::string_view dark = "#222222", soft = "#666666", empty = "#ececec", line = "#999999";

struct Rgb {
    double red, green, blue;
};
/// Orange and blue differ for color-blind readers; both ends are light enough for dark letters, and equally dark in
/// gray, where the number's sign says which it is.
constexpr Rgb worse{224, 130, 20}, equal{255, 255, 255}, better{92, 156, 214};

std::string color_of(double a12) {
    double const share = std::abs(a12 - 0.5) * 2;
    Rgb const& end = a12 < 0.5 ? worse : better;
    auto const mixed = [&](double from, double to) {
        return static_cast<int>(std::lround(from + share * (to - from)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mixed(equal.red, end.red), mixed(equal.green, end.green),
                       mixed(equal.blue, end.blue));
}

constexpr double field_height = 78, bar_width = 240, widest_label = 200, line_height = 15;
constexpr Label column_label{.anchor = Anchor::middle, .bold = true}, row_label{.anchor = Anchor::end, .bold = true},
    unit_label{.anchor = Anchor::middle, .size = 11, .color = soft};

struct Grid {
    double left, top, field_width;
    SvgPoint corner(std::size_t row, std::size_t column) const {
        return {left + field_width * static_cast<double>(column), top + field_height * static_cast<double>(row)};
    }
};

/// What a column's head says below the name of the task.
std::string head_of(std::vector<MatrixField> const& fields, std::string const& target) {
    for (MatrixField const& field : fields)
        if (field.pair.target == target && field.why.empty())
            return fmt::format("{}, generation {}", field.unit, field.generation);
    return "";
}

std::array<std::string, 4> lines_of(MatrixField const& field) {
    return {difference_text(field), difference_band_text(field),
            fmt::format("A12 {:.2f} ({:.2f} .. {:.2f})", field.a12, field.a12_band.low, field.a12_band.high),
            fmt::format("p = {}", p_text(field.p_holm))};
}

void draw_field(SvgDocument& svg, Grid const& grid, SvgPoint corner, MatrixField const& field) {
    std::string const color = field.why.empty() ? color_of(field.a12) : std::string{empty};
    svg.rect(corner, grid.field_width, field_height, {.fill = color});
    svg.rect(corner, grid.field_width, field_height, {.stroke = line, .width = 0.8});
    double const middle = corner.x + grid.field_width / 2;
    if (!field.why.empty()) {
        svg.text({middle, corner.y + field_height / 2 + 4}, field.why, {.anchor = Anchor::middle, .color = soft});
        return;
    }
    auto const [difference, band, effect, p] = lines_of(field);
    svg.text({middle, corner.y + 23}, difference, {.anchor = Anchor::middle, .size = 17, .color = dark, .bold = true});
    svg.text({middle, corner.y + 39}, band, {.anchor = Anchor::middle, .size = 11, .color = dark});
    svg.text({middle, corner.y + 56}, effect, {.anchor = Anchor::middle, .size = 11, .color = dark});
    svg.text({middle, corner.y + 70}, p, {.anchor = Anchor::middle, .size = 11, .color = dark});
}

void draw_scale(SvgDocument& svg, SvgPoint corner) {
    constexpr int steps = 40;
    for (int i = 0; i < steps; ++i) {
        std::string const color = color_of((i + 0.5) / steps);
        svg.rect({corner.x + bar_width * i / steps, corner.y}, bar_width / steps + 0.5, 12, {.fill = color});
    }
    svg.rect(corner, bar_width, 12, {.stroke = line, .width = 0.8});
    for (double const tick : {0.0, 0.25, 0.5, 0.75, 1.0})
        svg.text({corner.x + bar_width * tick, corner.y + 26}, fmt::format("{}", tick),
                 {.anchor = Anchor::middle, .size = 11});
    svg.text({corner.x - 8, corner.y + 10}, "A12", {.anchor = Anchor::end, .size = 11});
    svg.text({corner.x, corner.y - 6}, "worse", {.size = 11});
    svg.text({corner.x + bar_width, corner.y - 6}, "better with knowledge", {.anchor = Anchor::end, .size = 11});
}

}   // namespace

std::string draw_matrix(CampaignPlan const& plan, std::vector<MatrixField> const& fields) {
    double label_width = 80, field_width = 172;
    std::vector<std::vector<std::string>> rows, columns;   // lines of their labels
    for (Treatment const& source : plan.sources) {
        rows.push_back(broken_into_lines(source.label, widest_label, row_label));
        for (std::string const& words : rows.back()) label_width = std::max(label_width, text_width(words, row_label));
    }
    for (Treatment const& task : plan.tasks)
        field_width = std::max(field_width, text_width(head_of(fields, task.name), unit_label) + 16);
    std::size_t most_lines = 1;
    for (Treatment const& task : plan.tasks) {
        columns.push_back(broken_into_lines(task.label, field_width - 16, column_label));
        most_lines = std::max(most_lines, columns.back().size());
    }
    auto const height_of = [](std::size_t lines) { return line_height * (static_cast<double>(lines) - 1); };
    Grid const grid{44 + label_width, 66 + height_of(most_lines), field_width};
    SvgPoint const end = grid.corner(plan.sources.size(), plan.tasks.size());
    SvgDocument svg{std::max(end.x + 20, grid.left + bar_width + 40), end.y + 66,
                    "What knowledge of one task gives on another, over none"};
    svg.text({(grid.left + end.x) / 2, 20}, "runs on this task", {.anchor = Anchor::middle, .color = soft});
    svg.text({18, (grid.top + end.y) / 2}, "knowledge of this task",
             {.anchor = Anchor::middle, .color = soft, .rotation = -90});
    for (std::size_t column = 0; column < columns.size(); ++column) {
        double const middle = grid.corner(0, column).x + grid.field_width / 2;
        svg.text({middle, grid.top - 25 - height_of(columns[column].size())}, columns[column], line_height,
                 column_label);
        svg.text({middle, grid.top - 9}, head_of(fields, plan.tasks[column].name), unit_label);
    }
    for (std::size_t row = 0; row < rows.size(); ++row)
        svg.text({grid.left - 8, grid.corner(row, 0).y + field_height / 2 + 4 - height_of(rows[row].size()) / 2},
                 rows[row], line_height, row_label);
    for (std::size_t i = 0; i < fields.size(); ++i)
        draw_field(svg, grid, grid.corner(i / plan.tasks.size(), i % plan.tasks.size()), fields[i]);
    draw_scale(svg, {grid.left, end.y + 30});
    return std::move(svg).finish();
}

}   // namespace lore
