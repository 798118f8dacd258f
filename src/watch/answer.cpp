#include <lore/watch/answer.h>

#include "watch_assets.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace lore {

namespace {

WebAnswer plain(int status, std::string text) {
    return {status, "text/plain; charset=utf-8", std::make_shared<std::string const>(std::move(text))};
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
    auto const lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::string_view without_port(std::string_view host) {
    std::size_t const colon = host.rfind(':');
    std::size_t const bracket = host.rfind(']');
    if (colon == std::string_view::npos || (bracket != std::string_view::npos && colon < bracket)) return host;
    std::string_view const port = host.substr(colon + 1);
    bool const digits = !port.empty() && port.size() <= 5 &&
                        std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
    return digits ? host.substr(0, colon) : host;
}

}   // namespace

bool is_loopback(std::string_view host) {
    constexpr std::array<std::string_view, 3> ours{"localhost", "127.0.0.1", "[::1]"};
    std::string_view const name = without_port(host);
    return std::any_of(ours.begin(), ours.end(), [&](std::string_view own) { return equal_but_for_case(name, own); });
}

void WatchDocuments::publish(std::string facts, std::string replays) {
    auto new_facts = std::make_shared<std::string const>(std::move(facts));
    auto new_replays = std::make_shared<std::string const>(std::move(replays));
    std::lock_guard const guard{mutex_};
    facts_ = std::move(new_facts);
    replays_ = std::move(new_replays);
}

WebAnswer WatchDocuments::answer(WebRequest const& request) const {
    static auto const page = std::make_shared<std::string const>(watch_page);
    if (!is_loopback(request.host))
        return plain(403, "Only localhost is served. Open this page as http://localhost, with the port you used.\n");
    if (request.method != "GET") return plain(405, "Only GET is answered.\n");
    if (request.path == "/") return {200, "text/html; charset=utf-8", page};
    std::lock_guard const guard{mutex_};
    if (request.path == "/facts.json" && facts_) return {200, "application/json", facts_};
    if (request.path == "/replay.json" && replays_) return {200, "application/json", replays_};
    return plain(404, "There is /, /facts.json and /replay.json.\n");
}

}   // namespace lore
