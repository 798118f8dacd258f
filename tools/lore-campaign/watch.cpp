#include "http_server.h"
#include "subcommand.h"

#include <lore/campaign/board.h>
#include <lore/campaign/stop_signals.h>
#include <lore/core/stopwatch.h>
#include <lore/core/utf8.h>
#include <lore/report/replay_page.h>
#include <lore/watch/text_view.h>
#include <lore/watch/watcher.h>

#include <algorithm>

#include <unistd.h>

namespace lore::campaign_program {

namespace {

constexpr int usual_port = 8017;

void watch_options(CLI::App& app, Arguments& arguments) {
    add_campaign(app, arguments);
    CLI::Option* const port =
        app.add_option("--port", arguments.port,
                       fmt::format("of the page; 0: any that is free (default: {}, or any if it is taken)", usual_port))
            ->check(CLI::Range(0, 65535));
    app.add_flag("--text", arguments.as_text, "no page: show it here, drawn anew in place, or a line a change")
        ->excludes(port);
}

/// Calls `use` with the facts every 2 seconds or more, until it returns false or a signal asks to stop: looking takes
/// at most a twentieth of a core. Counted are processor seconds: on a busy machine a look takes longer and costs no
/// more.
template <class Use>
void keep_looking(StopSignals const& signals, CampaignWatcher& watcher, Use const& use) {
    while (signals.requests() == 0) {
        double const before = processor_seconds();
        if (!use(watcher.look())) return;
        signals.sleep(std::max(2.0, 20 * (processor_seconds() - before)));
    }
}

ExitCode show_text(CampaignWatcher& watcher) {
    StopSignals const signals;
    Board board{false};
    bool const live = board.live() && ::isatty(STDOUT_FILENO) != 0;
    CampaignFacts last;
    keep_looking(signals, watcher, [&](CampaignFacts now) {
        if (live) board.draw(picture_of(now));
        else
            for (std::string const& line : changes_between(last, now)) fmt::print("{}\n", line);
        last = std::move(now);
        return why_stdout_is_lost().empty();   // flushes
    });
    if (live) board.announce(summary_of(last));
    return ExitCode::done;
}

/// On the port that the user has chosen, or on the usual one, or on any.
HttpServer started_server(int port, WatchDocuments const& documents) {
    if (auto server = HttpServer::start(port < 0 ? usual_port : port, documents)) return *std::move(server);
    if (port < 0)
        if (auto server = HttpServer::start(0, documents)) return *std::move(server);
    throw Error(fmt::format("cannot listen on 127.0.0.1:{}", port), "another program has this port",
                "Give another with --port, or leave it out.");
}

ExitCode serve_page(Arguments const& arguments, CampaignWatcher& watcher) {
    StopSignals const signals;   // first: the server's thread leaves signals to this one
    WatchDocuments documents;
    auto const publish = [&](CampaignFacts const& facts) {
        documents.publish(facts_json(facts), replay_json(watcher.replays()));
        return true;
    };
    publish(watcher.look());
    HttpServer const server = started_server(arguments.port, documents);
    fmt::print("http://127.0.0.1:{}/ shows {}; Ctrl-C ends it\n", server.port(), harmless(arguments.directory));
    std::fflush(stdout);
    keep_looking(signals, watcher, publish);
    return ExitCode::done;
}

ExitCode watch_campaign(Arguments const& arguments) {
    CampaignWatcher watcher{arguments.file, arguments.directory};
    return arguments.as_text ? show_text(watcher) : serve_page(arguments, watcher);
}

}   // namespace

Subcommand const watch{"watch", "a page for the browser, on this machine alone, that shows a campaign at work",
                       watch_options, watch_campaign};

}   // namespace lore::campaign_program
