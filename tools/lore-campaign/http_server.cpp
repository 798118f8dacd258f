#include "http_server.h"

#include <lore/core/error.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <microhttpd.h>
#include <netinet/in.h>

namespace lore::campaign_program {

namespace {

constexpr unsigned most_connections = 200;
constexpr unsigned patience = 10;                ///< with a silent connection [s]
constexpr std::size_t most_memory = 32 * 1024;   ///< of a request with its headers [bytes]

/// The page brings its own style and scripts, asks only where it came from, and makes no HTML of text.
constexpr char content_policy[] =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; require-trusted-types-for 'script'";

MHD_Result send(MHD_Connection* connection, WebAnswer const& answer) {
    MHD_Response* const response = MHD_create_response_from_buffer(
        answer.body->size(), const_cast<char*>(answer.body->data()), MHD_RESPMEM_MUST_COPY);
    if (response == nullptr) return MHD_NO;
    MHD_add_response_header(response, "Content-Type", answer.type.c_str());
    MHD_add_response_header(response, "Cache-Control", "no-store");
    MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
    MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
    MHD_add_response_header(response, "Cross-Origin-Resource-Policy", "same-origin");
    MHD_add_response_header(response, "Content-Security-Policy", content_policy);
    if (answer.status == 405) MHD_add_response_header(response, "Allow", "GET");
    MHD_Result const queued = MHD_queue_response(connection, static_cast<unsigned>(answer.status), response);
    MHD_destroy_response(response);
    return queued;
}

/// Called once the headers are there. A body, which no answer needs, is not read.
MHD_Result handle(void* documents, MHD_Connection* connection, char const* url, char const* method, char const*,
                  char const*, std::size_t*, void**) {
    char const* const host = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Host");
    try {
        return send(connection,
                    static_cast<WatchDocuments const*>(documents)->answer({method, url, host == nullptr ? "" : host}));
    } catch (std::exception const&) { return MHD_NO; }   // out of memory: the connection is closed
}

}   // namespace

std::optional<HttpServer> HttpServer::start(int port, WatchDocuments const& documents) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    errno = 0;
    MHD_Daemon* const daemon = MHD_start_daemon(
        MHD_USE_AUTO_INTERNAL_THREAD, static_cast<std::uint16_t>(port), nullptr, nullptr, handle,
        const_cast<WatchDocuments*>(&documents), MHD_OPTION_SOCK_ADDR, reinterpret_cast<sockaddr*>(&address),
        MHD_OPTION_CONNECTION_LIMIT, most_connections, MHD_OPTION_CONNECTION_TIMEOUT, patience,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, most_memory, MHD_OPTION_END);
    if (daemon != nullptr) return HttpServer{daemon};
    int const reason = errno;
    if (reason == EADDRINUSE) return std::nullopt;
    throw Error(fmt::format("cannot listen on 127.0.0.1:{}", port),
                reason == 0 ? "the HTTP library gave no reason" : std::strerror(reason),
                "Give another port with --port, or use --text.");
}

HttpServer::HttpServer(HttpServer&& other) noexcept : daemon_(std::exchange(other.daemon_, nullptr)) {}

HttpServer::~HttpServer() {
    if (daemon_ != nullptr) MHD_stop_daemon(daemon_);
}

int HttpServer::port() const {
    MHD_DaemonInfo const* const info = MHD_get_daemon_info(daemon_, MHD_DAEMON_INFO_BIND_PORT);
    return info == nullptr ? 0 : info->port;
}

}   // namespace lore::campaign_program
