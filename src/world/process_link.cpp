#include "process_link.h"

#include "refusal.h"

#include <algorithm>
#include <cerrno>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

namespace lore {

namespace {

constexpr std::size_t longest_reason = 4000;    ///< of a failure [bytes]
constexpr std::size_t shown_of_nonsense = 60;   ///< [bytes]
constexpr double seconds_to_see_an_end = 1;     ///< of a process that has closed its output
constexpr int most_milliseconds = 1000;         ///< of a wait: then whether the process is alive

/// By which a question may be answered instead: the world's own failure, and its refusal of the settings.
constexpr std::string_view failure_tag = "failure", refusal_tag = "refused", facts_tag = "facts";

/// The first line of what should not be there, or the first bytes if it is no text.
std::string quoted(std::string_view bytes) {
    std::string_view const line = bytes.substr(0, std::min(bytes.find('\n'), shown_of_nonsense));
    bool const is_text = std::ranges::all_of(
        line, [](char c) { return static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\r' || c == '\033'; });
    if (is_text) return fmt::format("'{}'", line);
    std::string hex;
    for (char const c : bytes.substr(0, 8)) hex += fmt::format(" {:02x}", static_cast<unsigned char>(c));
    return "bytes" + hex;
}

}   // namespace

ProcessLink::ProcessLink(WorldProcess const& process)
    : patience_(process.patience), called_(fmt::format("world {}", fmt::join(process.command, " "))),
      child_(process.command, process.folder), buffer_(std::size_t{64} << 10) {}

std::span<char const> ProcessLink::ask(FrameWriter&& question, std::string_view expected, std::size_t most,
                                       std::string_view moment) {
    if (broken_) throw *broken_;
    std::string_view const sent = question.finish();
    std::uint32_t const batch = read_head(sent).batch;
    start_clock();
    send(sent, moment);
    receive(expected, most, moment);
    std::span<char const> const answer{buffer_.data(), received_};
    FrameHead const head = read_head(answer);
    auto const payload = answer.subspan(FrameHead::size);
    if (head.tag != expected) failed(head.tag, FrameReader{payload}.text(), moment);
    if (head.batch != batch)
        give_up(fmt::format("{} sent nonsense {}", called_, moment),
                fmt::format("it answered for batch {}, and batch {} was asked", head.batch, batch), "Mend it.");
    return payload;
}

void ProcessLink::tell(FrameWriter&& message) noexcept {
    if (broken_) return;
    try {
        start_clock();
        send(message.finish(), "at the end of a batch");
    } catch (Error const&) {}   // kept in broken_
}

void ProcessLink::give_up(std::string_view problem, std::string_view why, std::string_view remedy) {
    child_.kill();
    broken_.emplace(problem, why, remedy);
    throw *broken_;
}

void ProcessLink::start_clock() {
    limit_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{patience_});
}

void ProcessLink::send(std::string_view bytes, std::string_view moment) {
    while (!bytes.empty()) {
        ssize_t const written = ::write(child_.input(), bytes.data(), bytes.size());
        if (written >= 0) bytes.remove_prefix(static_cast<std::size_t>(written));
        else if (errno == EPIPE) return;   // it reads no more, and its output says why
        else if (errno == EAGAIN) wait(child_.input(), POLLOUT, moment);
        else if (errno != EINTR) ended(moment);
    }
}

/// Leaves a whole answer in the buffer: `expected`, or a failure.
void ProcessLink::receive(std::string_view expected, std::size_t most, std::string_view moment) {
    received_ = 0;
    for (std::size_t wanted = FrameHead::size; received_ < wanted;) {
        if (!read_more(moment)) ended(moment);
        std::string const why = why_no_answer(expected, most);
        if (!why.empty())
            give_up(fmt::format("{} sent nonsense {}", called_, moment), why,
                    "Let it write nothing but answers to its standard output.");
        if (received_ >= FrameHead::size) wanted = FrameHead::size + read_head(buffer_).payload;
        if (wanted > buffer_.size()) buffer_.resize(wanted);
    }
}

/// False at the end of the output.
bool ProcessLink::read_more(std::string_view moment) {
    for (;;) {
        wait(child_.output(), POLLIN, moment);
        ssize_t const got = ::read(child_.output(), buffer_.data() + received_, buffer_.size() - received_);
        if (got >= 0) {
            received_ += static_cast<std::size_t>(got);
            return got > 0;
        }
        if (errno != EINTR && errno != EAGAIN) ended(moment);
    }
}

void ProcessLink::wait(int descriptor, short events, std::string_view moment) {
    for (;;) {
        auto const left = std::chrono::ceil<std::chrono::milliseconds>(limit_ - Clock::now()).count();
        if (left <= 0)
            give_up(fmt::format("{} does not answer {}", called_, moment),
                    fmt::format("no answer came within {} s", patience_),
                    "Mend it, or allow more 'patience' in [world].");
        pollfd ready{descriptor, events, 0};
        int const found = ::poll(&ready, 1, static_cast<int>(std::min<long long>(left, most_milliseconds)));
        if (found > 0) return;
        // A process of its own may hold the pipes open.
        if (found == 0 && child_.end()) ended(moment);
    }
}

/// What is wrong with what has come of an answer so far; "" if nothing is.
std::string ProcessLink::why_no_answer(std::string_view expected, std::size_t most) const {
    std::string_view const bytes{buffer_.data(), received_};
    std::string_view const tag = bytes.substr(0, FrameHead::tag_size);
    auto const begins = [&](std::string_view word) { return padded_tag(word).starts_with(tag); };
    bool const is_failure = begins(failure_tag) || (expected == facts_tag && begins(refusal_tag));
    if (!begins(expected) && !is_failure)
        return fmt::format("{} where its answer '{}' was expected", quoted(bytes), expected);
    if (received_ < FrameHead::size) return "";
    std::size_t const payload = read_head(buffer_).payload;
    std::size_t const limit = is_failure ? longest_reason + 4 : most;
    if (payload > limit)
        return fmt::format("its answer '{}' has {} bytes, and {} at most", read_head(buffer_).tag, payload, limit);
    if (received_ > FrameHead::size + payload)
        return fmt::format("{} behind its answer '{}'", quoted(bytes.substr(FrameHead::size + payload)), expected);
    return "";
}

void ProcessLink::ended(std::string_view moment) {
    auto const how = child_.end(seconds_to_see_an_end);
    give_up(fmt::format("{} ended {}", called_, moment), how.value_or("it has closed its standard output"),
            "Mend it: what it said last is above.");
}

void ProcessLink::failed(std::string_view tag, std::string_view reason, std::string_view moment) {
    if (tag == refusal_tag) {
        child_.kill();
        refuse_settings(called_, reason);
    }
    give_up(fmt::format("{} failed {}", called_, moment), reason, "Mend it: what it said is above.");
}

}   // namespace lore
