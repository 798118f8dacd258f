#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace lore {

/// Threads that share work: one hands it out and takes part itself, the others join in. Some of these the crew starts;
/// guests are threads with work of their own, which come by every now and then and when they have nothing to do.
class Crew {
public:
    /// Does items first .. last - 1, as thread number `thread`: no two threads have one number at the same time.
    using Work = std::function<void(std::size_t thread, std::size_t first, std::size_t last)>;

    /// Of so many threads in all, at least 1: the one that hands out, `guests`, and the rest, which it starts. Throws
    /// Error where the system does not give so many.
    explicit Crew(int threads, int guests = 0);
    /// Guests must be gone.
    ~Crew();
    int threads() const { return threads_; }

    /// Calls `work` for all of `count` items, `share` neighbors at a time, from this thread, number 0, and from all who
    /// join in; returns when all are done, and rethrows the first thing that one has thrown. From one thread, and not
    /// from within work.
    void share(std::size_t count, std::size_t share, Work const& work);
    /// Of a guest: joins in what is shared now, if anything is. Costs next to nothing if not.
    void assist();
    /// Of a guest: joins in all that is shared until `done`, which is asked again whenever wake is called.
    void assist_until(std::function<bool()> const& done);
    void wake();

private:
    bool has_work() const { return open_ && taken_ < count_; }
    void join_in(std::unique_lock<std::mutex>&);
    void dismiss();
    void take_shares(std::size_t thread);

    int threads_;
    std::mutex mutex_;
    std::condition_variable changed_;
    // What is shared now; but for `taken_` it changes while nobody takes part, under the mutex.
    Work const* work_ = nullptr;
    std::size_t count_ = 0, share_ = 1;
    std::atomic<std::size_t> taken_{0};
    std::atomic<bool> open_{false};   ///< others may join in
    std::size_t joined_ = 0;          ///< so many have
    std::size_t inside_ = 0;          ///< of these are not yet done
    std::exception_ptr failure_;
    bool ending_ = false;
    std::vector<std::thread> helpers_;
};

}   // namespace lore
