#include "post.h"

#include <lore/archive/messages.h>

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <span>
#include <thread>
#include <utility>

namespace lore {

namespace {

constexpr std::uint32_t message_mark = 0x45524f4c;   ///< "LORE"
constexpr int polls_before_sleeping = 4000;          ///< longer than rank 0 takes between two generations
constexpr std::chrono::microseconds sleep{20};       ///< with the kernel's slack about 80
/// Of ranks that share processors: each look for messages takes time from somebody's evaluations.
constexpr std::chrono::microseconds long_sleep{200};

/// Behind the payload, which therefore need not move.
struct Trailer {
    std::uint32_t mark;
    std::int32_t kind;
    std::int64_t unit;
    std::uint64_t length;
};
static_assert(sizeof(Trailer) <= room_for_trailer);

}   // namespace

Error damaged_message(std::string const& why) {
    return {"a message between ranks is damaged", why, "Check that all ranks run the same build."};
}

Post::~Post() {
    // After a failure some messages may never be received; MPI_Abort follows.
    for (Outgoing& sent : outgoing_) MPI_Request_free(&sent.request);
}

void Post::forget_sent() {
    for (auto sent = outgoing_.begin(); sent != outgoing_.end();) {
        int gone = 0;
        MPI_Test(&sent->request, &gone, MPI_STATUS_IGNORE);
        sent = gone ? outgoing_.erase(sent) : std::next(sent);
    }
}

void Post::send(int to, MessageKind kind, int unit, Bytes payload) {
    forget_sent();
    Trailer const trailer{message_mark, static_cast<std::int32_t>(kind), unit, payload.size()};
    auto const bytes = std::as_bytes(std::span{&trailer, 1});
    payload.insert(payload.end(), bytes.begin(), bytes.end());
    if (payload.size() > std::numeric_limits<int>::max())
        throw Error("a message between ranks is too long",
                    fmt::format("MPI takes 2 GiB, it has {} bytes", payload.size()),
                    "Take a smaller population, or one rank.");
    outgoing_.push_back({std::move(payload), MPI_REQUEST_NULL});
    Outgoing& message = outgoing_.back();
    MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, to, static_cast<int>(kind), comm_,
              &message.request);
}

std::optional<Message> Post::receive(std::span<MessageKind const> kinds) {
    if (comm_ == MPI_COMM_NULL) return std::nullopt;   // one process, without MPI
    forget_sent();
    for (MessageKind const kind : kinds) {
        int there = 0;
        MPI_Message matched;
        MPI_Status status;
        MPI_Improbe(MPI_ANY_SOURCE, static_cast<int>(kind), comm_, &there, &matched, &status);
        if (!there) continue;
        int length = 0;
        MPI_Get_count(&status, MPI_BYTE, &length);
        Bytes bytes(static_cast<std::size_t>(length));
        MPI_Mrecv(bytes.data(), length, MPI_BYTE, &matched, &status);
        Trailer trailer{};
        if (bytes.size() >= sizeof trailer)
            std::memcpy(&trailer, bytes.data() + bytes.size() - sizeof trailer, sizeof trailer);
        if (trailer.mark != message_mark || trailer.kind != static_cast<std::int32_t>(kind) ||
            trailer.length != bytes.size() - sizeof trailer)
            throw damaged_message("its trailer does not fit");
        bytes.resize(bytes.size() - sizeof trailer);
        return Message{kind, status.MPI_SOURCE, static_cast<int>(trailer.unit), std::move(bytes)};
    }
    return std::nullopt;
}

Message Post::await(std::span<MessageKind const> kinds) {
    for (int polls = 0;; ++polls) {
        if (auto message = receive(kinds)) return *std::move(message);
        // Sleep instead of yield: the kernel wakes a sleeper before processes that keep the processor busy.
        if (sleeps_) std::this_thread::sleep_for(long_sleep);
        else if (polls > polls_before_sleeping) std::this_thread::sleep_for(sleep);
    }
}

void Post::flush() {
    while (!outgoing_.empty()) forget_sent();
}

}   // namespace lore
