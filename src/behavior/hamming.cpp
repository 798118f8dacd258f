#include "fast_distances.h"
#include "hamming_kernel.h"

#include <algorithm>
#include <cstring>

namespace lore {

namespace isa_baseline { extern HammingKernel const hamming; }
#if LORE_ISA_COUNT > 1
namespace isa_v3 { extern HammingKernel const hamming; }
namespace isa_v4 { extern HammingKernel const hamming; }
#endif

HammingKernel hamming_kernel(Isa isa) {
#if LORE_ISA_COUNT > 1
    if (isa == Isa::v4) return isa_v4::hamming;
    if (isa == Isa::v3) return isa_v3::hamming;
#endif
    static_cast<void>(isa);
    return isa_baseline::hamming;
}

void measure_hamming_rows(std::span<Descriptors const* const> pool, int first, int last, DistanceMatrix& matrix) {
    if (first >= last) return;
    pool = pool.first(static_cast<std::size_t>(last));
    std::size_t longest = 0;
    for (Descriptors const* d : pool) longest = std::max(longest, d->bits.size());
    constexpr std::size_t steps_per_line = sizeof(CacheLine) / sizeof(std::uint16_t), lines_per_block = 16;
    std::size_t const lines = (longest + steps_per_line * lines_per_block - 1) / (steps_per_line * lines_per_block) * lines_per_block;

    // Zeros after the end, where nothing differs. Robots that stopped at different times are left to the definition.
    std::vector<CacheLine> packed(lines * pool.size());
    auto const words_of = [&](int member) { return reinterpret_cast<std::uint64_t*>(packed.data() + lines * static_cast<std::size_t>(member)); };
    for (int i = 0; i < last; ++i)
        if (!pool[i]->bits.empty()) std::memcpy(words_of(i), pool[i]->bits.data(), pool[i]->bits.size() * sizeof(std::uint16_t));

    HammingKernel const kernel = hamming_kernel(active_isa());
    int const words = static_cast<int>(lines * sizeof(CacheLine) / sizeof(std::uint64_t));
    for (int i = first; i < last; ++i) {
        for (int j = 0; j < i; ++j) {
            std::size_t const a = pool[i]->bits.size(), b = pool[j]->bits.size();
            if (a != b) matrix.set(i, j, hamming_distance(*pool[i], *pool[j]));
            else if (a == 0) matrix.set(i, j, 0.0);
            else matrix.set(i, j, static_cast<double>(kernel.differing(words_of(i), words_of(j), words)) / static_cast<double>(a * bits_per_step));
        }
    }
}

} // namespace lore
