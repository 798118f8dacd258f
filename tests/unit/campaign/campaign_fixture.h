#pragma once

#include <lore/campaign/runner.h>
#include <lore/campaign/state.h>
#include <support/scratch.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace lore::test {

/// A campaign in small with programs that make up their numbers: 4 source runs, 5 knowledge bases, 3 treatments of 3.
inline std::string const small_campaign = R"(
title = "A small campaign"
runs = 3
generations = 20
[source]
config = "source.toml"
runs = 4
[[knowledge]]
name = "kb1"
balls = 6
[[knowledge]]
name = "kb2"
balls = 2
[[knowledge]]
name = "kb1_all"
all_of = "kb1"
[[knowledge]]
name = "kb1_random"
random_of = "kb1"
[[knowledge]]
name = "kb1_top"
part_of = "kb1"
top = 10
[[treatment]]
name = "none"
label = "no transfer"
config = "target.toml"
[[treatment]]
name = "kb1"
label = "KB1"
config = "target.toml"
knowledge = "kb1"
[[treatment]]
name = "all"
config = "target.toml"
knowledge = "kb1_all"
[report]
order = ["none", "all", "kb1"]
)";

class CampaignTest : public ::testing::Test {
protected:
    CampaignTest() {
        write("source.toml", "name = \"source\"\ntask = \"source\"\n");
        write("target.toml", "name = \"target\"\ntask = \"target\"\n");
        write("campaign.toml", small_campaign);
        ::unsetenv("LORE_FAKE_MS");
        ::unsetenv("LORE_FAKE_FAIL");
        ::unsetenv("LORE_FAKE_COUNT");
    }
    void write(std::string const& name, std::string const& text) const { std::ofstream{scratch.file(name)} << text; }
    std::string read(std::string const& path) const {
        std::ifstream file{path, std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    CampaignPlan plan() const { return read_campaign(scratch.file("campaign.toml")); }
    CampaignDirectory directory(std::string const& name = "c") const { return CampaignDirectory{scratch.file(name)}; }
    RunnerOptions options(int jobs = 2) const {
        RunnerOptions options;
        options.launcher.programs = LORE_FAKE_PROGRAMS;
        options.jobs = jobs;
        options.quiet = true;
        return options;
    }
    StepState state(std::string const& step, std::string const& name = "c") const {
        return state_of(plan(), directory(name), steps_named(steps_of(plan()), {step}).front());
    }

    Scratch scratch;
};

}   // namespace lore::test
