#include "subcommand.h"

#include <lore/campaign/stop_signals.h>
#include <lore/core/standard_streams.h>
#include <lore/core/stopwatch.h>
#include <lore/watch/events.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace lore::campaign_program {

namespace {

void events_options(CLI::App& app, Arguments& arguments) {
    app.add_option("DIR", arguments.directory, "a run's directory, or one with runs below it")->required();
    app.add_flag("--follow", arguments.follow, "go on as more happens, until Ctrl-C or the end of the one run");
    app.add_option("--every", arguments.every, "tell every so many generations, and a session's last")
        ->capture_default_str()
        ->check(CLI::Range(1, 10'000'000));
}

ExitCode print_events(Arguments const& arguments) {
    EventReader reader{arguments.directory, arguments.every};
    StopSignals const signals;
    while (true) {
        Stopwatch watch;
        for (std::string const& line : reader.look()) fmt::print("{}\n", line);
        bool const lost = !why_stdout_is_lost().empty();   // flushes
        if (!arguments.follow || lost || reader.ended()) break;
        // Looking takes at most a twentieth of a core.
        signals.sleep(std::max(1.0, 20 * watch.total()));
        if (signals.requests() > 0) break;
        if (stdout_has_lost_its_reader())
            throw Error("cannot write the result to stdout", std::strerror(EPIPE), "Send it where it can be written.");
    }
    if (!arguments.follow && reader.runs() == 0)
        throw UsageError(fmt::format("there is no run in {}", arguments.directory),
                         "no manifest.json in it or below it", "Check the path, or wait for one with --follow.");
    return ExitCode::done;
}

}   // namespace

Subcommand const events{"events", "what happens in runs, a JSON object a line, for trackers", events_options,
                        print_events};

}   // namespace lore::campaign_program
