#include "memory_growth.h"

#include "process_world.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define LORE_HEAP_IS_KEPT
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LORE_HEAP_IS_KEPT
#endif
#endif

namespace lore {

namespace {

constexpr int rounds = 3, batches_a_round = 200, steps = 20;

struct Memory {
    std::int64_t heap = 0;       ///< in use [bytes]
    std::int64_t resident = 0;   ///< of the whole process [bytes]
};

/// Of the process in which the world's code runs; of another one the heap is not known.
Memory memory_of(World const& world) {
    auto const* const elsewhere = dynamic_cast<ProcessWorld const*>(&world);
    Memory now;
    if (elsewhere == nullptr) {
        auto const heap = ::mallinfo2();
        now.heap = static_cast<std::int64_t>(heap.uordblks + heap.hblkhd);
    }
    std::ifstream statm{
        fmt::format("/proc/{}/statm", elsewhere == nullptr ? "self" : fmt::format("{}", elsewhere->link().process()))};
    std::int64_t size = 0;
    statm >> size >> now.resident;
    now.resident *= ::sysconf(_SC_PAGESIZE);
    return now;
}

void live_and_end(World const& world, int lives) {
    WorldFacts const& facts = world.facts();
    auto const n = static_cast<std::size_t>(lives);
    std::vector<float> sensors(facts.sensors.size() * n), x(n), y(n), rewards(n);
    std::vector<float> const effectors(facts.effectors.size() * n, 1.0f);
    std::vector<float> outcomes(static_cast<std::size_t>(facts.outcome_size) * n);
    std::vector<unsigned char> over(n);
    auto const batch = world.begin_lives(lives);
    for (int step = 0; step < steps; ++step) {
        batch->sense(sensors, x, y);
        batch->act(effectors, rewards, over);
    }
    batch->outcome(outcomes);
}

}   // namespace

MemoryGrowth memory_growth(World const& world, int lives) {
    MemoryGrowth growth{
        "", fmt::format("{} batches of {} lives and {} steps", (rounds + 1) * batches_a_round, lives, steps)};
#ifdef LORE_HEAP_IS_KEPT
    growth.measured = "not measured: AddressSanitizer keeps what is freed";
    static_cast<void>(world);
    static_cast<void>(memory_of);
    static_cast<void>(live_and_end);
#else
    auto const round = [&] {
        for (int batch = 0; batch < batches_a_round; ++batch) live_and_end(world, lives);
        return memory_of(world);
    };
    // The first round may grow: allocators and worlds keep what they will use again. A leak grows in each of the
    // others.
    Memory before = round();
    std::int64_t least_heap = INT64_MAX, least_resident = INT64_MAX;
    for (int i = 0; i < rounds; ++i) {
        Memory const now = round();
        least_heap = std::min(least_heap, now.heap - before.heap);
        least_resident = std::min(least_resident, now.resident - before.resident);
        before = now;
    }
    // Less than a byte a batch is no leak of each batch. What a library maps itself shows in pages only.
    constexpr std::int64_t least_pages = std::int64_t{256} << 10;
    std::int64_t const grown =
        std::max(least_heap >= batches_a_round ? least_heap : 0, least_resident >= least_pages ? least_resident : 0);
    if (grown > 0) growth.what = fmt::format("by {} bytes a batch of {} lives", grown / batches_a_round, lives);
#endif
    return growth;
}

}   // namespace lore
