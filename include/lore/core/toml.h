#pragma once

#include <lore/core/error.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lore {

/// A TOML table read strictly: every key must be asked for, or reject_unknown() complains with the nearest known one.
///
/// Each getter throws a UsageError that names the file, the line and the key if the value is absent (`required…`), of
/// another type, not finite or out of range. toml++ stays behind this door.
class TomlTable {
public:
    /// Whether errors name lines of the document: not of one that its author has never seen as lines.
    enum class Lines : std::uint8_t { named, unknown };
    /// `name` is what error messages call the document: a path, or "--set".
    static TomlTable parse(std::string_view text, std::string name, Lines lines = Lines::named);
    static TomlTable read_file(std::string const& path);

    bool has(std::string_view key) const;
    bool is_array(std::string_view key) const;   ///< also one of tables
    bool is_string(std::string_view key) const;
    /// Keys in the order of the document.
    std::vector<std::string> keys() const;

    std::optional<double> number(std::string_view key, double least, double most) const;
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t least, std::int64_t most) const;
    std::optional<bool> boolean(std::string_view key) const;
    std::optional<std::string> string(std::string_view key) const;
    std::optional<std::vector<std::string>> strings(std::string_view key) const;
    /// One string or an array of them; of an empty string, none.
    std::optional<std::vector<std::string>> one_or_more(std::string_view key) const;
    std::optional<std::vector<double>> numbers(std::string_view key) const;
    std::optional<TomlTable> table(std::string_view key) const;
    std::vector<TomlTable> tables(std::string_view key) const;   ///< array of tables; empty if absent

    double required_number(std::string_view key, double least, double most) const;
    std::string required_string(std::string_view key) const;
    std::vector<double> required_numbers(std::string_view key, std::size_t count) const;
    /// An array of pairs, such as points [[x, y], ...].
    std::vector<std::array<double, 2>> required_pairs(std::string_view key) const;
    TomlTable required_table(std::string_view key) const;

    /// All of it as text that is read line by line: "key = value\n" a key, in the order of the alphabet, values as TOML
    /// writes them, the keys of inner tables as "table.key". Throws UsageError for dates, tables within arrays, and
    /// keys that need quotes.
    std::string lines() const;

    /// Throws if the table holds a key that no getter has asked for.
    void reject_unknown() const;
    /// A UsageError that names this document and, if the key is there, its line.
    [[noreturn]] void fail(std::string_view key, std::string_view reason,
                           std::string_view remedy = "Correct it.") const;
    /// The same of a value that something else has refused.
    [[noreturn]] void fail(std::string_view key, Error const&) const;

private:
    struct Node;
    explicit TomlTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}
    std::shared_ptr<Node> node_;
};

/// A text as TOML writes it, in quotes, without control characters: it stays on its line.
std::string toml_string(std::string_view text);
/// An array of such strings, in one line.
std::string toml_strings(std::vector<std::string> const&);

}   // namespace lore
