#include <lore/core/crew.h>

#include <lore/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <system_error>
#include <utility>

namespace lore {

Crew::Crew(int threads, int guests) : threads_(threads) {
    assert(threads >= 1 && guests >= 0);
    try {
        for (int helper = guests + 1; helper < threads; ++helper)
            helpers_.emplace_back([this] { assist_until([this] { return ending_; }); });
    } catch (std::system_error const& error) {
        dismiss();
        throw Error(fmt::format("cannot start {} threads", threads), error.what(),
                    "Ask for fewer, or raise the limit (ulimit -u).");
    }
}

Crew::~Crew() { dismiss(); }

void Crew::dismiss() {
    {
        std::lock_guard const lock{mutex_};
        ending_ = true;
    }
    changed_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
}

void Crew::share(std::size_t count, std::size_t share, Work const& work) {
    bool const alone = threads_ == 1 || count <= share;
    {
        std::lock_guard const lock{mutex_};
        assert(!open_ && inside_ == 0);
        work_ = &work;
        count_ = count;
        share_ = share;
        taken_ = 0;
        joined_ = 0;
        open_ = !alone;
    }
    if (!alone) changed_.notify_all();
    take_shares(0);
    std::unique_lock lock{mutex_};
    open_ = false;
    changed_.wait(lock, [this] { return inside_ == 0; });
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::assist() {
    if (!open_) return;
    std::unique_lock lock{mutex_};
    if (has_work()) join_in(lock);
}

void Crew::assist_until(std::function<bool()> const& done) {
    std::unique_lock lock{mutex_};
    while (!done()) {
        if (has_work()) join_in(lock);
        else changed_.wait(lock);
    }
}

void Crew::wake() {
    { std::lock_guard const lock{mutex_}; }   // who has just asked whether it is done waits by now
    changed_.notify_all();
}

void Crew::join_in(std::unique_lock<std::mutex>& lock) {
    std::size_t const thread = ++joined_;
    assert(thread < static_cast<std::size_t>(threads_));   // nobody leaves before all shares are taken
    ++inside_;
    lock.unlock();
    take_shares(thread);
    lock.lock();
    if (--inside_ == 0) changed_.notify_all();
}

void Crew::take_shares(std::size_t thread) {
    try {
        for (std::size_t first; (first = taken_.fetch_add(share_)) < count_;)
            (*work_)(thread, first, std::min(first + share_, count_));
    } catch (...) {
        std::lock_guard const lock{mutex_};
        taken_ = count_;
        if (!failure_) failure_ = std::current_exception();
    }
}

}   // namespace lore
