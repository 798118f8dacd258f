#pragma once

#include "process_child.h"
#include "process_frame.h"

#include <lore/core/error.h>
#include <lore/world/process.h>

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// The process of a world, as who asks and is answered. One that ends, fails, is silent or sends something else than
/// its answer is killed; Error says so with the world and the moment, "at step 17", and so does each later question.
class ProcessLink {
public:
    /// Throws UsageError where it cannot be started.
    explicit ProcessLink(WorldProcess const&);

    /// Sends a frame and gives the payload of its answer, which must be `expected` for the same batch; valid until the
    /// next call. `most`: what the payload may have at most [bytes].
    std::span<char const> ask(FrameWriter&& question, std::string_view expected, std::size_t most,
                              std::string_view moment);
    /// Sends a frame that has no answer. What fails shows at the next question.
    void tell(FrameWriter&& message) noexcept;
    /// Kills the process: it has said what it must not.
    [[noreturn]] void give_up(std::string_view problem, std::string_view why, std::string_view remedy);

    std::string const& called() const { return called_; }
    void call(std::string called) { called_ = std::move(called); }
    pid_t process() const { return child_.id(); }

private:
    using Clock = std::chrono::steady_clock;

    void start_clock();
    void send(std::string_view bytes, std::string_view moment);
    void receive(std::string_view expected, std::size_t most, std::string_view moment);
    bool read_more(std::string_view moment);
    void wait(int descriptor, short events, std::string_view moment);
    std::string why_no_answer(std::string_view expected, std::size_t most) const;

    [[noreturn]] void ended(std::string_view moment);
    [[noreturn]] void failed(std::string_view tag, std::string_view reason, std::string_view moment);

    double patience_;
    std::string called_;   ///< "world cartpole short from python3 cartpole.py"
    ProcessChild child_;
    Clock::time_point limit_{};
    std::vector<char> buffer_;
    std::size_t received_ = 0;   ///< of the buffer
    std::optional<Error> broken_;
};

}   // namespace lore
