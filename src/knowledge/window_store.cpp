#include "window_store.h"

namespace lore {

namespace {

GrowingBytes bytes_in(std::string const& folder) { return folder.empty() ? GrowingBytes{} : GrowingBytes{folder}; }

template <class T>
std::span<T const> numbers_in(std::span<std::byte const> bytes) {
    return {reinterpret_cast<T const*>(bytes.data()), bytes.size() / sizeof(T)};
}

}   // namespace

WindowStore::WindowStore(KnowledgeConfig const& config, std::string const& folder)
    : channels_(config.channels), floats_(static_cast<std::size_t>(config.window_length) *
                                          static_cast<std::size_t>(config.channels.continuous_count())),
      bits_(bytes_in(folder)), values_(bytes_in(folder)) {}

void WindowStore::add(Window const& window) {
    std::vector<std::uint16_t> bits;
    append_binary_bits(channels_, window, bits);
    bits_.add(std::as_bytes(std::span{bits}));
    values_.add(std::as_bytes(window.values));
}

float const* WindowStore::values(int feature, std::vector<float>& copy) const {
    copy.resize(floats_);
    std::size_t const bytes = floats_ * sizeof(float);
    return reinterpret_cast<float const*>(
        values_.read(static_cast<std::uint64_t>(feature) * bytes, bytes, reinterpret_cast<std::byte*>(copy.data())));
}

WindowArrays WindowStore::release() {
    GrowingBytes::Whole bits = bits_.release(), values = values_.release();
    return {numbers_in<std::uint16_t>(bits.bytes), numbers_in<float>(values.bytes),
            std::make_shared<std::pair<std::shared_ptr<void const>, std::shared_ptr<void const>>>(
                std::move(bits.keep_alive), std::move(values.keep_alive))};
}

}   // namespace lore
