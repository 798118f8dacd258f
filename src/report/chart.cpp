#include "chart.h"

#include "reward_words.h"

#include <lore/figure/axis.h>
#include <lore/figure/svg.h>
#include <lore/statistics/quantiles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr std::string_view ink = "#222222", pale = "#dddddd", source_color = "#777777", lead_color = "#999999";

constexpr std::size_t colors = 7;    // that treatments can have
constexpr double name_height = 16;   // of a line's name [pixels]

/// The plotting area and its scales; the horizontal axis starts at 0.
struct Frame {
    double left, right, top, bottom;   ///< pixels
    double x_most, y_most;             ///< data
    double y_least = 0;
    double x(double value) const { return left + (right - left) * value / x_most; }
    double y(double value) const { return bottom - (bottom - top) * (value - y_least) / (y_most - y_least); }
};

/// The vertical scale of rewards that are not counts, with some room above and below.
void fit(Frame& frame, double least, double most) {
    double const room = most > least ? 0.04 * (most - least) : 1;
    frame.y_least = least - room;
    frame.y_most = most + room;
}

/// Round numbers from 0 to `most`; only whole ones, of what is counted.
std::vector<double> whole_ticks(double most) {
    std::vector<double> places = ticks(0, most, 8);
    std::erase_if(places, [](double place) { return place != std::round(place); });
    return places;
}

std::vector<double> reward_ticks(Frame const& frame, bool counts) {
    return counts ? whole_ticks(frame.y_most) : ticks(frame.y_least, frame.y_most, 8);
}

/// Moves the frame to the right where the labels of the reward axis would reach its title.
void make_room_for_labels(Frame& frame, bool counts) {
    std::size_t longest = 0;
    for (double const tick : reward_ticks(frame, counts)) longest = std::max(longest, tick_label(tick).size());
    double const more = std::max(0.0, 34 + 7.5 * static_cast<double>(longest) - frame.left);
    frame.left += more;
    frame.right += more;
}

void draw_reward_axis(SvgDocument& svg, Frame const& frame, bool counts, std::string_view what) {
    for (double const tick : reward_ticks(frame, counts)) {
        if (tick > frame.y_least)
            svg.line({frame.left, frame.y(tick)}, {frame.right, frame.y(tick)}, {.stroke = pale, .width = 0.7});
        svg.text({frame.left - 8, frame.y(tick) + 4}, tick_label(tick), {.anchor = Anchor::end});
    }
    svg.line({frame.left, frame.top}, {frame.left, frame.bottom}, {.stroke = ink});
    svg.line({frame.left, frame.bottom}, {frame.right, frame.bottom}, {.stroke = ink});
    svg.text({22, (frame.top + frame.bottom) / 2}, what, {.anchor = Anchor::middle, .rotation = -90});
}

struct Curve {
    std::string label;
    std::string_view color;
    std::string_view dashes;
    std::vector<CurveRow const*> rows;
    double end() const { return rows.back()->generation; }
};

/// A treatment, or the first of a pool: the others have its target task and its reward's unit.
std::string const& first_treatment(CampaignPlan const& plan, std::string const& name) {
    PoolPlan const* const pool = plan.pool(name);
    return pool == nullptr ? name : pool->treatments.front();
}

/// Names of treatments and pools, the treatments being of those of the plan's order.
std::vector<std::string> shown_names(CampaignPlan const& plan) {
    if (plan.figures.figure3.empty()) return plan.report_order;
    std::vector<std::string> names = plan.figures.figure3;
    std::erase_if(names, [&](std::string const& name) {
        std::vector<std::string> const& there = plan.report_order;
        return std::find(there.begin(), there.end(), first_treatment(plan, name)) == there.end();
    });
    return names;
}

/// Whether the runs of a treatment or pool have the unit of the figures' axis, or there are none.
bool has_unit_of_axis(CampaignPlan const& plan, Results const& results, std::string const& name) {
    std::string const unit = results.reward_unit(plan);
    return results.unit_of(first_treatment(plan, name)).value_or(unit) == unit;
}

constexpr std::array<std::string_view, 5> dashes{"", "6 4", "2 2", "9 3 2 3", "9 2 2 2 2 2"};

/// Tells the i-th treatment's line from those of the same color.
std::string_view treatment_dashes(std::size_t i) { return dashes[i / colors % dashes.size()]; }

/// Likewise; all source tasks have the same color.
std::string_view source_dashes(std::size_t i) { return dashes[1 + i % (dashes.size() - 1)]; }

/// One a treatment or pool that has runs: those of source tasks whose reward has the same unit, then those of the
/// report's order.
std::vector<Curve> curves_of(CampaignPlan const& plan, Results const& results) {
    // Source runs may be longer than those on the target task, which the figure is about.
    int last = -1;
    for (CurveRow const& row : results.curves)
        if (!plan.is_source(row.treatment)) last = std::max(last, row.generation);
    if (last < 0) last = std::numeric_limits<int>::max();

    std::vector<Curve> curves;
    auto const add = [&](std::string const& name, std::string const& label, std::string_view color,
                         std::string_view dashes) {
        if (!has_unit_of_axis(plan, results, name)) return;
        Curve curve{label, color, dashes, {}};
        for (CurveRow const& row : results.curves)
            if (row.treatment == name && row.generation <= last) curve.rows.push_back(&row);
        if (curve.rows.empty()) return;
        curve.label += fmt::format(" (n = {})", curve.rows.back()->runs);
        curves.push_back(std::move(curve));
    };
    for (std::size_t i = 0; i < plan.sources.size(); ++i)
        add(plan.sources[i].name, plan.sources[i].label, source_color, source_dashes(i));
    std::vector<std::string> const names = shown_names(plan);
    for (std::size_t i = 0; i < names.size(); ++i)
        add(names[i], plan.label(names[i]), treatment_color(i), treatment_dashes(i));
    return curves;
}

Paint line_of(Curve const& curve) { return {.stroke = curve.color, .width = 1.8, .dashes = curve.dashes}; }

/// Moves labels apart, keeping their order, as little as two sweeps can.
std::vector<double> spread(std::vector<double> const& wished, double gap, double top, double bottom) {
    std::vector<std::size_t> order(wished.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wished[a] < wished[b]; });
    std::vector<double> placed = wished;
    double least = top;
    for (std::size_t const i : order) {
        placed[i] = std::max(placed[i], least);
        least = placed[i] + gap;
    }
    double most = bottom;
    for (auto i = order.rbegin(); i != order.rend(); ++i) {
        placed[*i] = std::min(placed[*i], most);
        most = placed[*i] - gap;
    }
    return placed;
}

/// A bracket over two boxes; brackets on one level do not overlap.
struct Bracket {
    std::size_t from, to;
    std::string_view mark;
    std::size_t level = 0;
};

/// From the narrowest to the widest, each on the lowest level that is free over all it spans.
std::size_t stack(std::vector<Bracket>& brackets) {
    std::stable_sort(brackets.begin(), brackets.end(),
                     [](Bracket const& a, Bracket const& b) { return a.to - a.from < b.to - b.from; });
    std::size_t levels = 0;
    for (auto current = brackets.begin(); current != brackets.end(); ++current) {
        auto const taken = [&] {
            return std::any_of(brackets.begin(), current, [&](Bracket const& b) {
                return b.level == current->level && b.from < current->to && current->from < b.to;
            });
        };
        while (taken()) ++current->level;
        levels = std::max(levels, current->level + 1);
    }
    return levels;
}

void draw_box(SvgDocument& svg, Frame const& frame, double x, std::vector<double> const& rewards,
              std::string_view color) {
    constexpr double half = 26, whisker = 13;
    FiveNumbers const five = five_numbers(rewards);
    for (auto const& [end, box] :
         {std::pair{five.low_whisker, five.lower_quartile}, std::pair{five.high_whisker, five.upper_quartile}}) {
        svg.line({x, frame.y(end)}, {x, frame.y(box)}, {.stroke = ink});
        svg.line({x - whisker, frame.y(end)}, {x + whisker, frame.y(end)}, {.stroke = ink});
    }
    double const top = frame.y(five.upper_quartile), height = frame.y(five.lower_quartile) - top;
    svg.rect({x - half, top}, 2 * half, height, {.fill = color, .opacity = 0.18});
    svg.rect({x - half, top}, 2 * half, height, {.stroke = ink});
    svg.line({x - half, frame.y(five.median)}, {x + half, frame.y(five.median)}, {.stroke = ink, .width = 2.4});
    // Rewards may be counts: runs with equal ones stand side by side.
    std::map<double, int> of_value, drawn;
    for (double const value : rewards) ++of_value[value];
    for (double const value : rewards) {
        double const spacing = std::min(6.0, 76.0 / of_value[value]);
        double const offset = spacing * (drawn[value]++ - (of_value[value] - 1) / 2.0);
        svg.circle({x + offset, frame.y(value)}, 2.6, {.fill = color, .opacity = 0.75});
    }
}

}   // namespace

std::string_view treatment_color(std::size_t i) {
    static constexpr std::array<std::string_view, colors> okabe_ito{"#000000", "#56b4e9", "#e69f00", "#d55e00",
                                                                    "#0072b2", "#009e73", "#cc79a7"};
    return okabe_ito[i % okabe_ito.size()];
}

std::size_t drawn_sources(CampaignPlan const& plan, Results const& results) {
    return static_cast<std::size_t>(
        std::count_if(plan.sources.begin(), plan.sources.end(), [&](Treatment const& source) {
            return has_unit_of_axis(plan, results, source.name) &&
                   std::any_of(results.curves.begin(), results.curves.end(),
                               [&](CurveRow const& row) { return row.treatment == source.name; });
        }));
}

std::vector<std::string> labels_of_other_units(CampaignPlan const& plan, Results const& results) {
    std::vector<std::string> labels;
    for (std::string const& name : shown_names(plan))
        if (!has_unit_of_axis(plan, results, name)) labels.push_back(plan.label(name));
    return labels;
}

std::string draw_curves(CampaignPlan const& plan, Results const& results) {
    std::vector<Curve> const curves = curves_of(plan, results);
    RewardWords const words = reward_words(results.reward_unit(plan));
    Frame frame{64, 640, 24, 420, 1, 1};
    // The lines' names stand below each other.
    frame.bottom = std::max(
        frame.bottom, frame.top + 4 + name_height * (static_cast<double>(std::max<std::size_t>(curves.size(), 1)) - 1));
    bool const counts = results.are_counts();
    double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();
    for (Curve const& curve : curves) {
        frame.x_most = std::max(frame.x_most, curve.end());
        for (CurveRow const* row : curve.rows) {
            least = std::min(least, row->low);
            most = std::max(most, row->high);
        }
    }
    if (counts) frame.y_most = std::ceil(std::max(frame.y_most, most));
    else if (!curves.empty()) fit(frame, least, most);
    make_room_for_labels(frame, counts);

    double width = frame.right + 216;
    for (Curve const& curve : curves) width = std::max(width, frame.right + 48 + text_width(curve.label));
    SvgDocument svg{width, frame.bottom + 56, fmt::format("Mean {} of the best-of-run by generation", words.number_of)};
    draw_reward_axis(svg, frame, counts, words.collected + " (mean of best-of-runs)");
    for (double const tick : whole_ticks(frame.x_most)) {
        svg.line({frame.x(tick), frame.bottom}, {frame.x(tick), frame.bottom + 5}, {.stroke = ink});
        svg.text({frame.x(tick), frame.bottom + 20}, tick_label(tick), {.anchor = Anchor::middle});
    }
    svg.text({(frame.left + frame.right) / 2, frame.bottom + 44}, "generation", {.anchor = Anchor::middle});

    for (Curve const& curve : curves) {
        std::vector<SvgPoint> band;
        for (CurveRow const* row : curve.rows) band.push_back({frame.x(row->generation), frame.y(row->high)});
        for (auto row = curve.rows.rbegin(); row != curve.rows.rend(); ++row)
            band.push_back({frame.x((*row)->generation), frame.y((*row)->low)});
        svg.polygon(band, {.fill = curve.color, .opacity = 0.12});
    }
    std::vector<double> ends;
    for (Curve const& curve : curves) {
        std::vector<SvgPoint> line;
        for (CurveRow const* row : curve.rows) line.push_back({frame.x(row->generation), frame.y(row->mean)});
        svg.polyline(line, line_of(curve));
        ends.push_back(line.back().y);
    }
    // The lines are named at the right, with a piece of the line before the name; dots lead from where a line ends to
    // its name, and must not look like data where runs of fewer generations end early.
    std::vector<double> const placed = spread(ends, name_height, frame.top + 4, frame.bottom);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        SvgPoint const end{frame.x(curves[i].end()) + 2, ends[i]}, key{frame.right + 16, placed[i]};
        svg.line(end, key, {.stroke = lead_color, .width = 0.8, .dashes = "1 3"});
        svg.line(key, {key.x + 18, key.y}, line_of(curves[i]));
        svg.text({key.x + 24, key.y + 4}, curves[i].label);
    }
    if (curves.empty())
        svg.text({(frame.left + frame.right) / 2, 200}, "no finished run yet", {.anchor = Anchor::middle});
    return std::move(svg).finish();
}

std::string draw_boxplots(CampaignPlan const& plan, Results const& results,
                          std::vector<Comparison> const& comparisons) {
    struct Box {
        std::string name, label;
        std::string_view color;
        std::vector<double> rewards;
    };
    std::vector<Box> boxes;
    RewardWords const words = reward_words(results.reward_unit(plan));
    bool const counts = results.are_counts();
    double highest = std::numeric_limits<double>::lowest(), lowest = std::numeric_limits<double>::max();
    std::vector<std::string> const names = shown_names(plan);
    for (std::size_t i = 0; i < names.size(); ++i) {
        auto rewards = rewards_of(plan, results, names[i]);
        if (rewards.empty() || !has_unit_of_axis(plan, results, names[i])) continue;
        highest = std::max(highest, *std::max_element(rewards.begin(), rewards.end()));
        lowest = std::min(lowest, *std::min_element(rewards.begin(), rewards.end()));
        boxes.push_back({names[i], plan.label(names[i]), treatment_color(i), std::move(rewards)});
    }
    auto const place = [&](std::string const& name) {
        return static_cast<std::size_t>(
            std::find_if(boxes.begin(), boxes.end(), [&](Box const& b) { return b.name == name; }) - boxes.begin());
    };
    std::vector<Bracket> brackets;
    for (Comparison const& c : comparisons) {
        if (significance_mark(c.p).empty() || place(c.a) == boxes.size() || place(c.b) == boxes.size()) continue;
        auto const [from, to] = std::minmax({place(c.a), place(c.b)});
        brackets.push_back({from, to, significance_mark(c.p)});
    }
    double const bracket_height = 17, top = 30 + bracket_height * static_cast<double>(stack(brackets));

    double slot = 98;
    double const gap = plan.tasks.empty() ? 0 : 14;   // between labels, which say there what the knowledge is of
    for (Box const& box : boxes) slot = std::max(slot, text_width(box.label) + gap);
    double const right = 64 + slot * static_cast<double>(std::max<std::size_t>(boxes.size(), 3));
    Frame frame{64, right, top, top + 340, 1, 1};
    if (counts) frame.y_most = std::max(1.0, highest) + 0.4;   // room for the highest points' radius
    else if (!boxes.empty()) fit(frame, lowest, highest);
    make_room_for_labels(frame, counts);
    SvgDocument svg{frame.right + 20, frame.bottom + 56,
                    fmt::format("{} of the best-of-run at the last generation", capital(words.collected))};
    draw_reward_axis(svg, frame, counts, words.collected + " (best-of-run)");
    auto const center = [&](std::size_t i) { return frame.left + slot * (static_cast<double>(i) + 0.5); };
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        draw_box(svg, frame, center(i), boxes[i].rewards, boxes[i].color);
        svg.text({center(i), frame.bottom + 20}, boxes[i].label, {.anchor = Anchor::middle});
        svg.text({center(i), frame.bottom + 36}, fmt::format("n = {}", boxes[i].rewards.size()),
                 {.anchor = Anchor::middle, .size = 10});
    }
    for (Bracket const& bracket : brackets) {
        double const y = frame.top - 12 - bracket_height * static_cast<double>(bracket.level),
                     from = center(bracket.from) + 5, to = center(bracket.to) - 5, middle = (from + to) / 2;
        std::array<SvgPoint, 4> const shape{{{from, y + 4}, {from, y}, {to, y}, {to, y + 4}}};
        svg.polyline(shape, {.stroke = ink, .width = 0.8});
        svg.rect({middle - 9, y - 4}, 18, 8, {.fill = "#ffffff"});
        svg.text({middle, y + 6}, bracket.mark, {.anchor = Anchor::middle, .size = 14});
    }
    if (boxes.empty())
        svg.text({(frame.left + frame.right) / 2, 200}, "no finished run yet", {.anchor = Anchor::middle});
    return std::move(svg).finish();
}

}   // namespace lore
