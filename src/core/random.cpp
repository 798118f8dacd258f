#include <lore/core/random.h>

#include <Random123/philox.h>

namespace lore {

Stream::Stream(std::uint64_t seed, Purpose purpose, std::uint32_t generation, std::uint32_t slot)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, slot, generation, static_cast<std::uint32_t>(purpose)} {}

void Stream::refill() {
    r123::Philox4x32::ctr_type const counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
    r123::Philox4x32::key_type const key{{key_[0], key_[1]}};
    auto const block = r123::Philox4x32{}(counter, key);
    for (int i = 0; i < 4; ++i) block_[static_cast<std::size_t>(i)] = block[static_cast<std::size_t>(i)];
    ++counter_[0];
    used_ = 0;
}

std::uint32_t Stream::bits() {
    if (used_ == 4) refill();
    return block_[static_cast<std::size_t>(used_++)];
}

std::uint64_t Stream::bits64() {
    std::uint64_t const low = bits();
    return low | (static_cast<std::uint64_t>(bits()) << 32);
}

double Stream::uniform() { return static_cast<double>(bits64() >> 11) * 0x1.0p-53; }

std::uint32_t Stream::below(std::uint32_t count) {
    std::uint64_t product = static_cast<std::uint64_t>(bits()) * count;
    if (static_cast<std::uint32_t>(product) < count) {
        std::uint32_t const threshold = (0u - count) % count;
        while (static_cast<std::uint32_t>(product) < threshold) product = static_cast<std::uint64_t>(bits()) * count;
    }
    return static_cast<std::uint32_t>(product >> 32);
}

}   // namespace lore
