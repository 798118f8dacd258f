#include "sha256.h"

#include <lore/core/input_file.h>

#include <array>
#include <cerrno>
#include <vector>

#include <fmt/format.h>
#include <nettle/sha2.h>
#include <unistd.h>

namespace lore {

struct Sha256::State {
    sha256_ctx context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) { sha256_init(&state_->context); }
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(std::span<std::byte const> bytes) {
    sha256_update(&state_->context, bytes.size(), reinterpret_cast<std::uint8_t const*>(bytes.data()));
}

std::string Sha256::text() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&state_->context, digest.size(), digest.data());
    std::string all;
    for (std::uint8_t const byte : digest) all += fmt::format("{:02x}", byte);
    return all;
}

std::string sha256_of(std::string_view text) {
    Sha256 sum;
    sum.update(std::as_bytes(std::span{text.data(), text.size()}));
    return sum.text();
}

FileSum read_in_pieces(std::string const& path, BetweenPieces const& between,
                       std::function<void(std::span<std::byte const>)> const& use) {
    InputFile const file = open_regular(path);
    Sha256 sum;
    FileSum found;
    std::vector<std::byte> piece(std::size_t{1} << 20);
    while (true) {
        between();
        ssize_t const got = ::read(file.descriptor.get(), piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw file_error("read", path, errno);
        if (got == 0) break;
        std::span const bytes{piece.data(), static_cast<std::size_t>(got)};
        sum.update(bytes);
        found.bytes += bytes.size();
        if (use) use(bytes);
    }
    found.sha256 = sum.text();
    return found;
}

}   // namespace lore
