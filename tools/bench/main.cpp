// Benchmarks of every hot path.
//
//   lore-bench --benchmark_list_tests
//   lore-bench --benchmark_filter=knowledge/query --benchmark_repetitions=5
//   lore-bench --write_knowledge=base.lorekb
//
// The last writes the knowledge base that the benchmarks ask, for whole runs with one of a known size;
// --individuals=N takes it from N individuals instead of 600. Other options are those of Google Benchmark.
#include "../main.h"
#include "learned_base.h"

#include <lore/archive/knowledge_file.h>
#include <lore/core/error.h>
#include <lore/experiment/version.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <string>
#include <string_view>

namespace {

/// The value of --name=value, taken out of the arguments; empty if it is not there.
std::string_view take_option(std::string_view name, int& argc, char** argv) {
    std::string_view value;
    int kept = 0;
    for (int i = 0; i < argc; ++i) {
        std::string_view const argument{argv[i]};
        if (argument.starts_with(name)) value = argument.substr(name.size());
        else argv[kept++] = argv[i];
    }
    argc = kept;
    return value;
}

int count_in(std::string_view text) {
    int count = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc{} || end != text.data() + text.size() || count < 1)
        throw lore::UsageError(fmt::format("--individuals={} is not understood", text), "it is no number above 0",
                               "Give one such as 600.");
    return count;
}

constexpr char help_text[] = R"(Benchmarks of every hot path.

Examples:
  lore-bench --benchmark_list_tests
  lore-bench --benchmark_filter=knowledge/query --benchmark_repetitions=5
  lore-bench --write_knowledge=base.lorekb --individuals=600    the knowledge base that the benchmarks ask

Options:
  --version            of Lore
  --write_knowledge=FILE, --individuals=N
  --benchmark_...      of Google Benchmark:

)";

int run(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        std::string_view const argument{argv[i]};
        if (argument == "--version") {
            fmt::print("{}\n", lore::version_text("lore-bench"));
            return 0;
        }
        if (argument == "--help") {
            fmt::print("{}", help_text);
            std::fflush(stdout);
        }
    }
    std::string_view const path = take_option("--write_knowledge=", argc, argv);
    std::string_view const individuals = take_option("--individuals=", argc, argv);
    if (!path.empty()) {
        int const count = individuals.empty() ? lore::usual_teachers : count_in(individuals);
        lore::KnowledgeBase const base = lore::build_base(count, lore::make_exact_index(lore::usual_windows()));
        lore::write_knowledge_base(std::string{path}, base);
        fmt::print("wrote {}: {} features from {} individuals\n", path, base.size(), base.provenance().individuals);
        return 0;
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}

}   // namespace

int main(int argc, char** argv) {
    return lore::run_program("lore-bench", [&] { return run(argc, argv); });
}
