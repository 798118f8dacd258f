#include <lore/core/crew.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace lore;

namespace {

/// Of so many items: how often each was done, and whether two threads had one number at the same time.
class Done {
public:
    Done(std::size_t items, int threads) : times_(items), busy_(static_cast<std::size_t>(threads)) {}

    Crew::Work work() {
        return [this](std::size_t thread, std::size_t first, std::size_t last) {
            if (busy_.at(thread).exchange(true)) shared_number_ = true;
            for (std::size_t i = first; i < last; ++i) ++times_[i];
            busy_[thread] = false;
        };
    }
    void expect_each(int times) const {
        for (std::atomic<int> const& one : times_) ASSERT_EQ(one, times);
        EXPECT_FALSE(shared_number_);
    }

private:
    std::vector<std::atomic<int>> times_;
    std::vector<std::atomic<bool>> busy_;
    std::atomic<bool> shared_number_{false};
};

/// Work of two items, each of which is done only while another thread does the other; who is left alone fails the test.
class Meeting {
public:
    Crew::Work work() {
        return [this](std::size_t, std::size_t, std::size_t) {
            std::unique_lock lock{mutex_};
            ++present_;
            changed_.notify_all();
            EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds{20}, [this] { return present_ == 2; }))
                << "nobody else has come";
        };
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int present_ = 0;
};

}   // namespace

TEST(Crew, does_every_item_once_whatever_the_threads_and_the_shares) {
    for (int const threads : {1, 2, 5})
        for (std::size_t const items : {0u, 1u, 7u, 1000u})
            for (std::size_t const share : {1u, 3u, 512u}) {
                Crew crew{threads};
                Done done{items, threads};
                for (int time = 1; time <= 20; ++time) {
                    crew.share(items, share, done.work());
                    done.expect_each(time);
                }
            }
}

TEST(Crew, has_threads_of_its_own_that_join_in) {
    Crew crew{2};
    Meeting meeting;
    crew.share(2, 1, meeting.work());
}

TEST(Crew, is_joined_by_a_guest_that_comes_by) {
    Crew crew{2, 1};
    std::atomic<bool> gone{false};
    std::thread guest{[&] {
        while (!gone) crew.assist();
    }};
    Meeting meeting;
    crew.share(2, 1, meeting.work());
    gone = true;
    guest.join();
}

TEST(Crew, is_joined_by_a_guest_that_waits_until_it_is_woken_and_has_something_else_to_do) {
    Crew crew{2, 1};
    std::atomic<bool> enough{false}, left{false};
    std::thread guest{[&] {
        crew.assist_until([&] { return enough.load(); });
        left = true;
    }};
    for (int time = 0; time < 100 && !HasFailure(); ++time) {
        Meeting meeting;
        crew.share(2, 1, meeting.work());
    }
    EXPECT_FALSE(left);
    enough = true;
    crew.wake();
    guest.join();
}

TEST(Crew, lets_a_guest_go_on_at_once_if_nothing_is_shared) {
    Crew crew{2, 1};
    std::thread{[&] { crew.assist(); }}.join();
    std::thread{[&] { crew.assist_until([] { return true; }); }}.join();
    Done done{100, 2};
    crew.share(100, 1, done.work());   // nobody is left to join in
    done.expect_each(1);
}

TEST(Crew, rethrows_what_one_of_its_threads_has_thrown_and_does_the_next_work) {
    for (int const threads : {1, 2, 5}) {
        Crew crew{threads};
        for (std::size_t const bad : {0u, 50u, 99u})
            EXPECT_THROW(crew.share(100, 1,
                                    [&](std::size_t, std::size_t first, std::size_t) {
                                        if (first == bad) throw std::runtime_error{"no"};
                                    }),
                         std::runtime_error);
        Done done{100, threads};
        crew.share(100, 1, done.work());
        done.expect_each(1);
    }
}

TEST(Crew, rethrows_what_a_guest_has_thrown_and_the_guest_goes_on) {
    Crew crew{2, 1};
    std::atomic<bool> enough{false};
    std::thread guest{[&] { crew.assist_until([&] { return enough.load(); }); }};
    Meeting meeting;
    auto const met = meeting.work();
    EXPECT_THROW(crew.share(2, 1,
                            [&](std::size_t thread, std::size_t first, std::size_t last) {
                                met(thread, first, last);
                                if (thread == 1) throw std::runtime_error{"no"};
                            }),
                 std::runtime_error);
    enough = true;
    crew.wake();
    guest.join();
}
