#include <lore/collectball/trace_file.h>

#include <lore/core/error.h>

#include <support/complaint.h>
#include <support/scratch.h>

#include <gtest/gtest.h>

#include <fstream>

#include <zlib.h>

namespace lore {
namespace {

Arena const& arena() {
    static Arena const made = load_arena("collectball", "source");
    return made;
}

std::vector<StepRecord> some_steps() {
    std::vector<Effectors> actions(50, Effectors{0.71f, 0.69f, 0.9f});
    return drive(arena(), actions);
}

std::string written(Scratch const& scratch, std::string const& content) {
    std::string const path = scratch.file("trace.csv");
    std::ofstream{path, std::ios::binary} << content;
    return path;
}

/// The message with which the text is refused.
std::string refusal(std::string const& content) {
    Scratch const scratch;
    return test::complaint_of([&] { read_trace_csv(written(scratch, content), arena()); });
}

/// The text with the field in one row of the named column changed; row 0 is the header.
std::string changed(std::string const& text, int row, std::string const& column, std::string const& value) {
    std::string const header = text.substr(0, text.find('\n'));
    auto const commas = std::count(
        header.begin(), header.begin() + static_cast<std::ptrdiff_t>(header.find("," + column + ",")) + 1, ',');
    std::size_t at = 0;
    for (int i = 0; i < row; ++i) at = text.find('\n', at) + 1;
    for (int i = 0; i < commas; ++i) at = text.find(',', at) + 1;
    return text.substr(0, at) + value + text.substr(text.find_first_of(",\n", at));
}

void expect_refused(std::string const& content, std::string const& part) {
    std::string const message = refusal(content);
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(TraceFile, is_read_back_to_the_last_bit) {
    Scratch const scratch;
    std::vector<StepRecord> const steps = some_steps();
    EXPECT_EQ(read_trace_csv(written(scratch, trace_csv(steps)), arena()), steps);
}

TEST(TraceFile, has_the_promised_columns) {
    std::string const text = trace_csv(some_steps());
    EXPECT_EQ(text.substr(0, text.find('\n')),
              "step,x,y,theta,in0,in1,in2,in3,in4,in5,in6,in7,in8,in9,in10,in11,a0,a1,a2,carrying,door_open,balls_mask,"
              "collected,switch_on,switch_timer,x_next,y_next,theta_next");
}

TEST(TraceFile, may_be_compressed) {
    Scratch const scratch;
    std::vector<StepRecord> const steps = some_steps();
    std::string const text = trace_csv(steps), path = scratch.file("trace.csv.gz");
    gzFile const file = gzopen(path.c_str(), "wb");
    ASSERT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
    gzclose(file);
    EXPECT_EQ(read_trace_csv(path, arena()), steps);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    EXPECT_THROW(read_trace_csv(path, arena()), Error) << "cut";
}

TEST(TraceFile, may_have_further_columns_spaces_empty_lines_and_foreign_line_ends) {
    Scratch const scratch;
    std::ofstream{scratch.file("a.csv"), std::ios::binary} << "still, a1 ,a0,a2\r\n7, 0.25,0,1\r\n\r\n8,1,0.5,1";
    std::vector<Effectors> const expected{{0.0f, 0.25f, 1.0f}, {0.5f, 1.0f, 1.0f}};
    EXPECT_EQ(read_actions_csv(scratch.file("a.csv")), expected);
}

TEST(TraceFile, that_is_wrong_is_refused_with_line_and_column) {
    std::string const good = trace_csv(some_steps());
    EXPECT_EQ(refusal(good), "");
    expect_refused("", "empty");
    expect_refused(good.substr(0, good.find('\n')), "no row");
    expect_refused(changed(good, 0, "theta", "thta"), "no column 'theta', only 'thta'");
    expect_refused(changed(good, 0, "a1", "a0"), "two columns are called 'a0'");
    expect_refused(changed(good, 3, "x", "nan"), "line 4, column x");
    expect_refused(changed(good, 3, "in4", "inf"), "line 4, column in4");
    expect_refused(changed(good, 3, "y", ""), "line 4, column y");
    expect_refused(changed(good, 3, "y", "1e3"), "outside 0 .. 400.34");
    expect_refused(changed(good, 3, "a2", "1.5"), "outside 0 .. 1");
    expect_refused(changed(good, 3, "balls_mask", "256"), "outside 0 .. 255");
    expect_refused(changed(good, 3, "carrying", "0.5"), "whole number");
    expect_refused(changed(good, 3, "collected", "99999999999999"), "whole number");
    expect_refused(good.substr(0, good.size() - 12), "28");
}

TEST(TraceFile, that_is_missing_or_a_directory_is_refused) {
    Scratch const scratch;
    EXPECT_THROW(read_trace_csv(scratch.file("none.csv"), arena()), UsageError);
    EXPECT_THROW(read_actions_csv(scratch.path()), UsageError);
}

}   // namespace
}   // namespace lore
