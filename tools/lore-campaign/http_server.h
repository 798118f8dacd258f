#pragma once

#include <lore/watch/answer.h>

#include <optional>

struct MHD_Daemon;

namespace lore::campaign_program {

/// Answers HTTP on the loopback address alone, in a thread of its own, from documents in memory.
///
/// One thread waits for all connections at once, so that a slow client keeps no other waiting. A request of more than
/// 32 KiB is refused, a silent connection is closed after 10 s, and there are at most 200 at a time. The door of GNU
/// libmicrohttpd.
class HttpServer {
public:
    /// Listens on this port of 127.0.0.1; 0: any that is free. Nothing if the port is taken. The documents must outlive
    /// it. Throws Error where the system fails otherwise.
    static std::optional<HttpServer> start(int port, WatchDocuments const&);
    HttpServer(HttpServer&& other) noexcept;
    HttpServer& operator=(HttpServer&&) = delete;
    /// Ends all connections.
    ~HttpServer();

    int port() const;

private:
    explicit HttpServer(MHD_Daemon* daemon) : daemon_(daemon) {}
    MHD_Daemon* daemon_;
};

}   // namespace lore::campaign_program
