#include <lore/cluster/farm.h>

#include "distance_farm.h"
#include "guarded_evaluation.h"

#include <lore/archive/messages.h>
#include <lore/core/stopwatch.h>

#include <deque>
#include <span>
#include <string_view>

namespace lore {

namespace {

/// Bytes of a message with evaluations. Of more than 64 kB, its own header included, Open MPI over TCP asks the
/// receiver first, and a rank 0 that receives from many would wait for each a way there and back.
constexpr std::size_t longest_answer = 60'000;

template <class Items>
Bytes bytes_of(Items const& items) {
    auto const bytes = std::as_bytes(std::span{items});
    return {bytes.begin(), bytes.end()};
}

/// Fills this rank's lanes with the genomes that rank 0 sends, also while they run, and sends back their evaluations.
class PostedQueue : public EvaluationQueue {
public:
    explicit PostedQueue(Post& post) : post_(post) {}

    void take(Message const& message) {
        int ticket = message.unit;
        for (Genome& genome : unpack_genomes(message.payload)) waiting_.push_back({ticket++, std::move(genome)});
    }
    std::optional<Item> next() override {
        send_finished();
        if (waiting_.empty()) look();
        if (waiting_.empty()) return std::nullopt;
        present_ = std::move(waiting_.front());
        waiting_.pop_front();
        return Item{present_.ticket, &present_.genome};
    }
    void deliver(int ticket, Evaluation evaluation) override { finished_.push_back({ticket, std::move(evaluation)}); }
    void pulse() override {
        if (++pulses_ % pulses_a_look == 0) look();
    }

    /// Lanes that started together end together.
    void send_finished() {
        for (Bytes& message : pack_deliveries(finished_, longest_answer))
            post_.send(0, MessageKind::evaluated, 0, std::move(message));
        finished_.clear();
    }

private:
    void look() {
        MessageKind const kinds[]{MessageKind::evaluate};
        while (auto message = post_.receive(kinds)) take(*message);
    }

    struct Waiting {
        int ticket = 0;
        Genome genome;
    };
    Post& post_;
    std::deque<Waiting> waiting_;
    std::vector<Delivery> finished_;
    Waiting present_;
    unsigned pulses_ = 0;
};

}   // namespace

void serve(Communicator const& communicator, EvaluationContext context) {
    GuardedEvaluation lanes{std::move(context), communicator.rank()};
    Post post{communicator.handle().comm};
    RankTimes times;
    DistanceWorker distances{post, communicator.rank(), communicator.size()};
    MessageKind const kinds[]{MessageKind::pool, MessageKind::evaluate, MessageKind::stop};
    while (true) {
        Stopwatch watch;
        Message const message = post.await(kinds);
        times.waiting += watch.lap();
        if (message.kind == MessageKind::stop) break;
        if (message.kind == MessageKind::evaluate) {
            PostedQueue queue{post};
            queue.take(message);
            auto const culprit = lanes.evaluate(queue);
            queue.send_finished();
            if (culprit) post.send(0, MessageKind::failure, culprit->ticket, bytes_of(culprit->reason));
            times.evaluation += watch.lap();
        } else {
            try {
                distances.measure(message);
            } catch (std::exception const& error) {
                post.send(0, MessageKind::failure, message.unit, bytes_of(std::string_view{error.what()}));
            }
            times.distances += watch.lap();
        }
    }
    times.processor = processor_seconds();
    post.send(0, MessageKind::times, 0, bytes_of(std::span{&times, 1}));
    post.flush();
}

}   // namespace lore
