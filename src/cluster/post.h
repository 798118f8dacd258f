#pragma once

#include "handle.h"

#include <lore/archive/container.h>
#include <lore/core/error.h>

#include <cstdint>
#include <list>
#include <optional>
#include <string>

namespace lore {

/// Pulses of an evaluation queue between two looks for messages. Pulses come about every 25 us; a look at every second
/// one took 4 % of a worker's time.
inline constexpr int pulses_a_look = 8;

/// What a message is; also its MPI tag, so that a receiver asks for what it can take and nothing else.
enum class MessageKind : int {
    evaluate = 1,   ///< genomes; unit: the ticket of the first, the others follow
    evaluated,      ///< evaluations, each with its ticket
    pool,           ///< what a distance compares of all members; each rank measures its range of them
    distances,      ///< these
    failure,        ///< unit: the ticket of an evaluation that threw, or nothing of a pool; payload: the reason
    stop,           ///< leave serve()
    times           ///< what a worker spent its time on: a RankTimes
};

struct Message {
    MessageKind kind;
    int sender = 0;
    int unit = 0;   ///< which part of a request it belongs to
    Bytes payload;
};
/// The payload of a message that carries text.
inline std::string text_of(Message const& message) {
    return {reinterpret_cast<char const*>(message.payload.data()), message.payload.size()};
}

/// Of a message that a rank of another build may have sent; `why` says what does not fit.
Error damaged_message(std::string const& why);

/// Sends and receives Lore's byte messages: the payload, then a small trailer (magic, kind, unit, length), in one MPI
/// message. Without a communicator nothing ever arrives.
class Post {
public:
    explicit Post(MPI_Comm comm) : comm_(comm) {}
    Post(Post const&) = delete;
    Post& operator=(Post const&) = delete;
    ~Post();

    /// Returns at once; the bytes are kept until they have gone.
    void send(int to, MessageKind, int unit, Bytes payload);
    /// A message of one of these kinds, from any rank, if one is there. Throws Error if it is not one of Lore's.
    std::optional<Message> receive(std::span<MessageKind const>);
    /// Waits for one, giving the processor to others when it takes long.
    Message await(std::span<MessageKind const>);
    /// Until everything sent has gone.
    void flush();

private:
    void forget_sent();

    struct Outgoing {
        Bytes bytes;
        MPI_Request request;
    };
    MPI_Comm comm_;
    bool sleeps_ = sleeps_while_waiting();
    std::list<Outgoing> outgoing_;
};

}   // namespace lore
