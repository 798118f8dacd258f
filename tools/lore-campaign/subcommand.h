#pragma once

#include "program.h"

#include <lore/campaign/runner.h>
#include <lore/interchange/pack.h>

#include <string>
#include <vector>

namespace lore::campaign_program {

/// What the command line says. Each subcommand reads the members that it has options for.
struct Arguments {
    std::string file, directory;   ///< of the campaign
    RunnerOptions runner;
    int jobs = 0;             ///< of `run`; 0: cores / ranks
    std::string time_limit;   ///< of `submit`
    int concurrent = 0;
    std::vector<std::string> cluster_options;
    bool only_write = false;
    std::string out;             ///< of `report`, `export` and `pack`
    std::string first, second;   ///< of `test`
    bool interval = false;
    int port = -1;   ///< of `watch`; -1: none was given
    bool as_text = false;
    bool follow = false;   ///< of `events`
    int every = 1;         ///< generations
    PackOptions pack;      ///< of `pack`; which parts it leaves out is said by name
    std::vector<std::string> leave_out;
    bool quiet = false;
};

/// A subcommand: what it is called, the options it takes (bound to the arguments), and what it does.
struct Subcommand {
    char const* name;
    char const* description;
    void (*add_options)(CLI::App&, Arguments&);
    ExitCode (*work)(Arguments const&);
};

extern Subcommand const plan, run, submit, report, replay, status, test, watch, events, export_results, pack, verify;

/// FILE and --dir, of all that work on a campaign.
void add_campaign(CLI::App&, Arguments&);
/// --ranks, --launch and --programs, of those that start runs or say how.
void add_launcher(CLI::App&, Arguments&);

}   // namespace lore::campaign_program
