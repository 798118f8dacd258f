// The switch of nodes.py: carries Ethernet frames between tap devices as links of a set delay and bandwidth would.
//
//   node_switch DELAY BANDWIDTH TAP...    [s], of one way; [bit/s], of each link either way; descriptors of the taps of
//                                         nodes 0, 1, .., whose hardware addresses end in their numbers
//
// A frame takes its sender's link as long as its bits need, begins at its receiver's link DELAY later, or when that is
// free, and is there when that has carried it. Ends with the process that started it.

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <limits>
#include <vector>

#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace {

constexpr std::size_t longest_frame = 1 << 16;
constexpr double never = std::numeric_limits<double>::infinity();

struct Frame {
    double arrival;   // [s] of the monotonic clock
    std::vector<unsigned char> bytes;
};

struct Node {
    int tap;
    double sender_free = 0, receiver_free = 0;
    std::deque<Frame> coming = {};   // in the order of their arrival
};

double now() {
    timespec at{};
    clock_gettime(CLOCK_MONOTONIC, &at);
    return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

void deliver(std::vector<Node>& nodes) {
    for (Node& node : nodes)
        for (; !node.coming.empty() && node.coming.front().arrival <= now(); node.coming.pop_front()) {
            // A tap that cannot take a frame loses it, as a link would; TCP sends it again.
            [[maybe_unused]] auto const written =
                write(node.tap, node.coming.front().bytes.data(), node.coming.front().bytes.size());
        }
}

/// Until the next frame arrives; nothing where none is under way.
bool wait_time(std::vector<Node> const& nodes, timespec& wait) {
    double next = never;
    for (Node const& node : nodes)
        if (!node.coming.empty()) next = std::min(next, node.coming.front().arrival);
    if (next == never) return false;
    double const seconds = std::max(0.0, next - now()), whole = std::floor(seconds);
    wait = {static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9)};
    return true;
}

/// Puts all frames that the node has sent on their way.
void take(std::vector<Node>& nodes, Node& from, double delay, double bandwidth) {
    static unsigned char frame[longest_frame];
    for (ssize_t size = 0; (size = read(from.tap, frame, sizeof frame)) > 0;) {
        bool const to_one = size > 5 && (frame[0] & 1) == 0;   // to all: nothing that MPI needs
        if (!to_one || frame[5] >= nodes.size()) continue;
        Node& to = nodes[frame[5]];
        double const seconds = static_cast<double>(size) * 8 / bandwidth, begin = std::max(now(), from.sender_free);
        from.sender_free = begin + seconds;
        to.receiver_free = std::max(begin + delay, to.receiver_free) + seconds;
        to.coming.push_back({to.receiver_free, {frame, frame + size}});
    }
}

}   // namespace

int main(int count, char** words) {
    if (count < 4) return 2;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    sched_param const before_ranks{1};   // which keep the processors busy; without the right to it, in turn with them
    sched_setscheduler(0, SCHED_FIFO, &before_ranks);
    double const delay = std::atof(words[1]), bandwidth = std::atof(words[2]);
    std::vector<Node> nodes;
    std::vector<pollfd> taps;
    for (int i = 3; i < count; ++i) {
        nodes.push_back({std::atoi(words[i])});
        taps.push_back({nodes.back().tap, POLLIN, 0});
    }
    for (;;) {
        deliver(nodes);
        timespec wait{};
        if (ppoll(taps.data(), taps.size(), wait_time(nodes, wait) ? &wait : nullptr, nullptr) < 0 && errno != EINTR)
            return 1;
        for (std::size_t i = 0; i < taps.size(); ++i)
            if (taps[i].revents & POLLIN) take(nodes, nodes[i], delay, bandwidth);
    }
}
