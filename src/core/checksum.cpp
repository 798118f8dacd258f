#include <lore/core/checksum.h>

#include <lore/core/input_file.h>

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <memory>
#include <vector>

#include <unistd.h>

namespace lore {

std::uint64_t checksum(std::span<std::byte const> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }
std::uint64_t checksum(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

std::uint64_t checksum_of_file(std::string const& path) {
    InputFile const file = open_regular(path);
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> const state{XXH3_createState(), &XXH3_freeState};
    XXH3_64bits_reset(state.get());
    std::vector<std::byte> piece(1u << 20);
    while (true) {
        ssize_t const got = ::read(file.descriptor.get(), piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw file_error("read", path, errno);
        if (got == 0) return XXH3_64bits_digest(state.get());
        XXH3_64bits_update(state.get(), piece.data(), static_cast<std::size_t>(got));
    }
}

std::string checksum_text(std::uint64_t sum) { return fmt::format("{:016x}", sum); }

}   // namespace lore
