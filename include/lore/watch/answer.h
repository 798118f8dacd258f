#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace lore {

/// What the page's server needs to know of a request; everything else of it is ignored.
struct WebRequest {
    std::string method;
    std::string path;   ///< without the query
    std::string host;   ///< the header Host; empty without one
};

struct WebAnswer {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::shared_ptr<std::string const> body;
};

/// Whether a Host header names this machine by a name of its own: localhost, 127.0.0.1 or [::1], at any port, since a
/// tunnel may have another. A page of the web whose name was made to lead here comes with that name.
bool is_loopback(std::string_view host);

/// The documents that are served, as of the last look. The thread that looks publishes, those that answer read: no
/// request touches the disk.
class WatchDocuments {
public:
    void publish(std::string facts, std::string replays);

    /// GET of "/", "/facts.json" and "/replay.json"; 403 for another host, 405 for another method, 404 for another
    /// path.
    WebAnswer answer(WebRequest const&) const;

private:
    mutable std::mutex mutex_;
    std::shared_ptr<std::string const> facts_, replays_;
};

}   // namespace lore
