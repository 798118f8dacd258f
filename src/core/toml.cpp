#include <lore/core/toml.h>

#include <lore/core/error.h>
#include <lore/core/input_file.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace lore {

namespace {

constexpr std::string_view bare_key = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

template <class Number>
void check_range(TomlTable const& table, std::string_view key, Number value, Number least, Number most) {
    if (value < least || value > most)
        table.fail(key, fmt::format("{} is outside {} .. {}", value, least, most),
                   fmt::format("Take a number from {} to {}.", least, most));
}

/// A value as TOML writes it, a float with its shortest digits; nothing for one that lines() refuses.
std::optional<std::string> written(toml::node const& node) {
    if (auto const text = node.as_string()) return toml_string(text->get());
    if (auto const truth = node.as_boolean()) return truth->get() ? "true" : "false";
    if (auto const whole = node.as_integer()) return fmt::format("{}", whole->get());
    if (auto const real = node.as_floating_point()) {
        std::string const digits = fmt::format("{}", real->get());
        return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
    }
    toml::array const* const array = node.as_array();
    if (array == nullptr) return std::nullopt;
    std::string all;
    for (toml::node const& element : *array) {
        auto const one = written(element);
        if (!one) return std::nullopt;
        all.append(all.empty() ? "" : ", ").append(*one);
    }
    return "[" + all + "]";
}

}   // namespace

std::string toml_string(std::string_view text) {
    std::string all = "\"";
    for (char const c : text) {
        if (c == '"' || c == '\\') all.append(1, '\\').append(1, c);
        else if (c == '\n') all += "\\n";
        else if (c == '\t') all += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) all += fmt::format("\\u{:04X}", c);
        else all += c;
    }
    return all + '"';
}

std::string toml_strings(std::vector<std::string> const& texts) {
    std::string list;
    for (std::string const& text : texts) list += (list.empty() ? "" : ", ") + toml_string(text);
    return "[" + list + "]";
}

/// One table of a document. `document` keeps the parsed whole alive.
struct TomlTable::Node {
    std::shared_ptr<toml::table const> document;
    toml::table const* table = nullptr;
    std::string name;
    std::string path;        ///< "evolution." for the keys of [evolution]
    bool has_lines = true;   ///< that errors may name
    mutable std::set<std::string, std::less<>> asked;

    toml::node const* find(std::string_view key) const {
        asked.emplace(key);
        return table->get(key);
    }
};

TomlTable TomlTable::parse(std::string_view text, std::string name, Lines lines) {
    try {
        auto document = std::make_shared<toml::table const>(toml::parse(text, name));
        auto node = std::make_shared<Node>();
        node->document = document;
        node->table = document.get();
        node->name = std::move(name);
        node->has_lines = lines == Lines::named;
        return TomlTable{std::move(node)};
    } catch (toml::parse_error const& error) {
        if (lines == Lines::unknown)
            throw UsageError(name, std::string{error.description()},
                             "Give a number, true, false, a text in quotes or a list.");
        throw UsageError(fmt::format("cannot read {}", name),
                         fmt::format("line {}: {}", error.source().begin.line, error.description()),
                         "Mend the TOML syntax.");
    }
}

TomlTable TomlTable::read_file(std::string const& path) { return parse(read_text(path), path); }

void TomlTable::fail(std::string_view key, std::string_view reason, std::string_view remedy) const {
    toml::node const* at = key.empty() ? nullptr : node_->table->get(key);
    std::string const where = node_->has_lines && at != nullptr && at->source().begin.line != 0
                                  ? fmt::format("{}, line {}", node_->name, at->source().begin.line)
                                  : node_->name;
    throw UsageError(fmt::format("{}: {}{}", where, node_->path, key), reason, remedy);
}

void TomlTable::fail(std::string_view key, Error const& error) const {
    fail(key, error.reason().empty() ? error.problem() : fmt::format("{}: {}", error.problem(), error.reason()),
         error.remedy());
}

bool TomlTable::has(std::string_view key) const { return node_->find(key) != nullptr; }

bool TomlTable::is_array(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    return node != nullptr && node->is_array();
}

bool TomlTable::is_string(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    return node != nullptr && node->is_string();
}

std::vector<std::string> TomlTable::keys() const {
    std::vector<std::pair<toml::source_position, std::string>> found;
    for (auto const& [key, value] : *node_->table) found.emplace_back(key.source().begin, std::string{key.str()});
    std::stable_sort(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (auto& entry : found) names.push_back(std::move(entry.second));
    return names;
}

std::optional<double> TomlTable::number(std::string_view key, double least, double most) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    std::optional<double> const value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value) fail(key, "a number is expected");
    if (!std::isfinite(*value)) fail(key, "the value is not finite");
    check_range(*this, key, *value, least, most);
    return value;
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t least, std::int64_t most) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    std::optional<std::int64_t> const value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value) fail(key, "a whole number is expected");
    check_range(*this, key, *value, least, most);
    return value;
}

std::optional<bool> TomlTable::boolean(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_boolean()) fail(key, "true or false is expected");
    return node->value<bool>();
}

std::optional<std::string> TomlTable::string(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_string()) fail(key, "a string in quotes is expected");
    return node->value<std::string>();
}

std::optional<std::vector<std::string>> TomlTable::strings(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    toml::array const* const array = node->as_array();
    if (array == nullptr) fail(key, "an array of strings is expected");
    std::vector<std::string> values;
    for (toml::node const& element : *array) {
        if (!element.is_string()) fail(key, "an array of strings is expected");
        values.push_back(*element.value<std::string>());
    }
    return values;
}

std::optional<std::vector<std::string>> TomlTable::one_or_more(std::string_view key) const {
    if (is_array(key)) return strings(key);
    if (has(key) && !is_string(key)) fail(key, "a string in quotes, or an array of them, is expected");
    auto one = string(key);
    if (!one) return std::nullopt;
    return one->empty() ? std::vector<std::string>{} : std::vector{*std::move(one)};
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    toml::array const* const array = node->as_array();
    if (array == nullptr) fail(key, "an array of numbers is expected");
    std::vector<double> values;
    for (toml::node const& element : *array) {
        if (!element.is_number()) fail(key, "an array of numbers is expected");
        values.push_back(*element.value<double>());
        if (!std::isfinite(values.back())) fail(key, "a value is not finite");
    }
    return values;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return std::nullopt;
    toml::table const* const inner = node->as_table();
    if (inner == nullptr) fail(key, "a table is expected");
    auto child = std::make_shared<Node>();
    child->document = node_->document;
    child->table = inner;
    child->name = node_->name;
    child->has_lines = node_->has_lines;
    child->path = fmt::format("{}{}.", node_->path, key);
    return TomlTable{std::move(child)};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) return {};
    toml::array const* const array = node->as_array();
    if (array == nullptr) fail(key, "an array of tables is expected");
    std::vector<TomlTable> found;
    for (std::size_t i = 0; i < array->size(); ++i) {
        toml::table const* const inner = array->get(i)->as_table();
        if (inner == nullptr) fail(key, "an array of tables is expected");
        auto child = std::make_shared<Node>();
        child->document = node_->document;
        child->table = inner;
        child->name = node_->name;
        child->has_lines = node_->has_lines;
        child->path = fmt::format("{}{}[{}].", node_->path, key, i);
        found.push_back(TomlTable{std::move(child)});
    }
    return found;
}

double TomlTable::required_number(std::string_view key, double least, double most) const {
    auto const value = number(key, least, most);
    if (!value) fail(key, "the key is missing", "Add it.");
    return *value;
}

std::string TomlTable::required_string(std::string_view key) const {
    auto value = string(key);
    if (!value) fail(key, "the key is missing", "Add it.");
    return *std::move(value);
}

std::vector<double> TomlTable::required_numbers(std::string_view key, std::size_t count) const {
    auto values = numbers(key);
    if (!values) fail(key, "the key is missing", "Add it.");
    if (values->size() != count) fail(key, fmt::format("{} numbers are expected, not {}", count, values->size()));
    return *std::move(values);
}

std::vector<std::array<double, 2>> TomlTable::required_pairs(std::string_view key) const {
    toml::node const* const node = node_->find(key);
    if (node == nullptr) fail(key, "the key is missing", "Add it.");
    toml::array const* const array = node->as_array();
    if (array == nullptr) fail(key, "an array of pairs of numbers is expected");
    std::vector<std::array<double, 2>> pairs;
    for (toml::node const& element : *array) {
        toml::array const* const pair = element.as_array();
        if (pair == nullptr || pair->size() != 2 || !pair->get(0)->is_number() || !pair->get(1)->is_number())
            fail(key, "an array of pairs of numbers is expected");
        pairs.push_back({*pair->get(0)->value<double>(), *pair->get(1)->value<double>()});
        if (!std::isfinite(pairs.back()[0]) || !std::isfinite(pairs.back()[1])) fail(key, "a value is not finite");
    }
    return pairs;
}

TomlTable TomlTable::required_table(std::string_view key) const {
    auto value = table(key);
    if (!value) fail(key, "the table is missing", "Add it.");
    return *std::move(value);
}

std::string TomlTable::lines() const {
    std::map<std::string, std::string> sorted;
    auto const add = [&](auto const& self, TomlTable const& table, std::string const& prefix) -> void {
        for (std::string const& key : table.keys()) {
            if (key.empty() || key.find_first_not_of(bare_key) != std::string::npos)
                table.fail(key, "the key is not of letters, digits, '_' and '-'", "Rename it.");
            toml::node const& node = *table.node_->find(key);
            if (node.is_table()) {
                self(self, *table.table(key), prefix + key + ".");
            } else if (auto value = written(node)) {
                sorted.emplace(prefix + key, *std::move(value));
            } else {
                table.fail(key, "it is neither a number, a text, true, false, nor an array of such",
                           "Write one of them.");
            }
        }
    };
    add(add, *this, "");
    std::string all;
    for (auto const& [key, value] : sorted) all += fmt::format("{} = {}\n", key, value);
    return all;
}

void TomlTable::reject_unknown() const {
    for (std::string const& key : keys()) {
        if (node_->asked.contains(key)) continue;
        std::vector<std::string_view> const known(node_->asked.begin(), node_->asked.end());
        std::string const meant = nearest_word(key, known.data(), known.size());
        fail(key, "unknown key",
             meant.empty() ? "Remove it." : fmt::format("Did you mean '{}{}'?", node_->path, meant));
    }
}

}   // namespace lore
