#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace lore {

/// SHA-256 of bytes that come in pieces. The door of nettle.
class Sha256 {
public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;
    void update(std::span<std::byte const>);
    /// 64 lower-case hexadecimal digits; once.
    std::string text();

private:
    struct State;
    std::unique_ptr<State> state_;
};

std::string sha256_of(std::string_view text);

/// A file's length and sum, of the same bytes.
struct FileSum {
    std::uint64_t bytes = 0;
    std::string sha256;
};

/// Called between pieces of a long piece of work; may throw to stop it.
using BetweenPieces = std::function<void()>;

/// Reads a regular file in pieces and hands each to `use`. Throws Error.
FileSum read_in_pieces(std::string const& path, BetweenPieces const& between,
                       std::function<void(std::span<std::byte const>)> const& use = {});

}   // namespace lore
