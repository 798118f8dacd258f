#include "subcommand.h"

#include <lore/core/input_file.h>
#include <lore/statistics/bootstrap.h>
#include <lore/statistics/mann_whitney.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace lore::campaign_program {

namespace {

void test_options(CLI::App& app, Arguments& arguments) {
    app.add_option("A", arguments.first, "first sample")->required();
    app.add_option("B", arguments.second, "second sample")->required();
    app.add_flag("--interval", arguments.interval, "also the 95 % bootstrap interval of A12");
}

/// One number a line; empty lines do not count.
std::vector<double> read_sample(std::string const& path) {
    std::istringstream file{read_text(path)};
    std::vector<double> sample;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        std::size_t const first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos) continue;
        line = line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
        double value = 0;
        auto const [end, failed] = std::from_chars(line.data(), line.data() + line.size(), value);
        if (failed != std::errc{} || end != line.data() + line.size() || std::isnan(value))
            throw UsageError(fmt::format("{}, line {}: '{}' is no number", path, number, line.substr(0, 40)),
                             "one number a line is expected", "Remove headers and other columns.");
        sample.push_back(value);
    }
    if (sample.empty())
        throw UsageError(fmt::format("{} has no number", path), "one number a line is expected", "Check the path.");
    return sample;
}

ExitCode test_samples(Arguments const& arguments) {
    auto const first = read_sample(arguments.first), second = read_sample(arguments.second);
    MannWhitney const result = mann_whitney(first, second);
    fmt::print("U {} p {} A12 {}", result.u, result.p, vargha_delaney_a12(first, second));
    if (arguments.interval) {
        Interval const band = bootstrap_a12(first, second);
        fmt::print(" {} .. {}", band.low, band.high);
    }
    fmt::print("\n");
    return ExitCode::done;
}

}   // namespace

Subcommand const test{"test", "two-sided Mann-Whitney test of two files with one number a line", test_options,
                      test_samples};

}   // namespace lore::campaign_program
