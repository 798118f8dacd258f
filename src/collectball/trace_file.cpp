#include <lore/collectball/trace_file.h>

#include <lore/core/csv.h>
#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <array>
#include <iterator>
#include <limits>
#include <new>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

namespace lore {

namespace {

constexpr std::size_t most_trace = std::size_t{1} << 30;   ///< of a trace's text [bytes]; a step has some 300

constexpr std::string_view gzip_mark = "\x1f\x8b";

/// The text of a gzip file, all of its members.
std::string inflated(std::string_view packed, std::string const& path) {
    auto const refuse = [&](std::string_view reason) {
        throw Error(fmt::format("cannot read {}", path), reason, "Fetch it again.");
    };
    z_stream stream{};
    constexpr int gzip_only = 16 + MAX_WBITS;
    if (inflateInit2(&stream, gzip_only) != Z_OK) throw std::bad_alloc{};
    struct End {
        z_stream* stream;
        ~End() { inflateEnd(stream); }
    } const end{&stream};
    std::string text;
    std::array<char, 1 << 16> block;
    while (true) {
        auto const piece = static_cast<uInt>(std::min(packed.size(), block.size()));
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
        stream.avail_in = piece;
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        int const status = inflate(&stream, Z_NO_FLUSH);
        if (status == Z_BUF_ERROR) refuse("the compressed file is cut");
        if (status != Z_OK && status != Z_STREAM_END) refuse(stream.msg != nullptr ? stream.msg : "it is damaged");
        packed.remove_prefix(piece - stream.avail_in);
        text.append(block.data(), block.size() - stream.avail_out);
        if (text.size() > most_trace) refuse(fmt::format("its text has more than {} bytes", most_trace));
        if (status != Z_STREAM_END) continue;
        if (!packed.starts_with(gzip_mark)) return text;
        inflateReset(&stream);
    }
}

/// The whole file, uncompressed where it is gzip.
std::string read_trace_text(std::string const& path) {
    std::string text = read_text(path, most_trace);
    return text.starts_with(gzip_mark) ? inflated(text, path) : text;
}

constexpr std::string_view remedy = "Compare with the columns in docs/manual/formats.md.";

CsvTable read_table(std::string const& path) {
    CsvTable table{path, read_trace_text(path), remedy};
    if (table.rows() == 0) table.refuse("it has a header but no row");
    return table;
}

constexpr float whole_turn = 6.2831855f;
constexpr float largest_sensor = 1e6f;   // other simulators' range sensors leave [0, 1] by a little
constexpr int largest_count = 1 << 30;

std::array<std::size_t, effector_count> effector_columns(CsvTable const& csv) {
    std::array<std::size_t, effector_count> columns;
    for (int i = 0; i < effector_count; ++i) columns[static_cast<std::size_t>(i)] = csv.column(fmt::format("a{}", i));
    return columns;
}

}   // namespace

std::string trace_csv(std::vector<StepRecord> const& rows) {
    std::string text = "step,x,y,theta";
    for (int i = 0; i < sensor_count; ++i) text += fmt::format(",in{}", i);
    for (int i = 0; i < effector_count; ++i) text += fmt::format(",a{}", i);
    text += ",carrying,door_open,balls_mask,collected,switch_on,switch_timer,x_next,y_next,theta_next\n";
    auto const out = std::back_inserter(text);
    for (StepRecord const& row : rows) {
        fmt::format_to(out, "{},{},{},{}", row.step, row.pose.x, row.pose.y, row.pose.theta);
        for (float const sensor : row.sensors) fmt::format_to(out, ",{}", sensor);
        for (float const effector : row.effectors) fmt::format_to(out, ",{}", effector);
        fmt::format_to(out, ",{:d},{:d},{},{},{:d},{},{},{},{}\n", row.carrying, row.door_open, row.balls_mask,
                       row.collected, row.switch_lit, row.switch_timer, row.next.x, row.next.y, row.next.theta);
    }
    return text;
}

std::vector<StepRecord> read_trace_csv(std::string const& path, Arena const& arena) {
    CsvTable const csv = read_table(path);
    std::size_t const step = csv.column("step"), x = csv.column("x"), y = csv.column("y"), theta = csv.column("theta");
    std::size_t const carrying = csv.column("carrying"), door_open = csv.column("door_open"),
                      balls_mask = csv.column("balls_mask"), collected = csv.column("collected"),
                      switch_on = csv.column("switch_on"), switch_timer = csv.column("switch_timer");
    std::size_t const x_next = csv.column("x_next"), y_next = csv.column("y_next"),
                      theta_next = csv.column("theta_next");
    std::array<std::size_t, sensor_count> sensors;
    for (int i = 0; i < sensor_count; ++i) sensors[static_cast<std::size_t>(i)] = csv.column(fmt::format("in{}", i));
    auto const effectors = effector_columns(csv);
    int const all_balls = (1 << arena.task.ball_positions.size()) - 1;

    std::vector<StepRecord> rows;
    for (std::size_t r = 0; r < csv.rows(); ++r) {
        StepRecord row;
        row.step = csv.number(r, step, 0, largest_count);
        row.pose = {csv.number(r, x, 0.0f, arena.width), csv.number(r, y, 0.0f, arena.height),
                    csv.number(r, theta, -whole_turn, whole_turn)};
        for (std::size_t i = 0; i < sensors.size(); ++i)
            row.sensors[i] = csv.number(r, sensors[i], -largest_sensor, largest_sensor);
        for (std::size_t i = 0; i < effectors.size(); ++i) row.effectors[i] = csv.number(r, effectors[i], 0.0f, 1.0f);
        row.carrying = csv.number(r, carrying, 0, 1) != 0;
        row.door_open = csv.number(r, door_open, 0, 1) != 0;
        row.balls_mask = static_cast<std::uint16_t>(csv.number(r, balls_mask, 0, all_balls));
        row.collected = csv.number(r, collected, 0, largest_count);
        row.switch_lit = csv.number(r, switch_on, 0, 1) != 0;
        row.switch_timer = csv.number(r, switch_timer, 0, int{std::numeric_limits<std::int16_t>::max()});
        row.next = {csv.number(r, x_next, 0.0f, arena.width), csv.number(r, y_next, 0.0f, arena.height),
                    csv.number(r, theta_next, -whole_turn, whole_turn)};
        rows.push_back(row);
    }
    return rows;
}

std::vector<Effectors> read_actions_csv(std::string const& path) {
    CsvTable const csv = read_table(path);
    std::array<std::size_t, effector_count> const columns{csv.column("a0"), csv.column("a1"), csv.column("a2")};
    std::vector<Effectors> actions;
    for (std::size_t r = 0; r < csv.rows(); ++r) {
        Effectors& action = actions.emplace_back();
        for (std::size_t i = 0; i < columns.size(); ++i) action[i] = csv.number(r, columns[i], 0.0f, 1.0f);
    }
    return actions;
}

}   // namespace lore
