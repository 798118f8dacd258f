#include "crate_reading.h"

#include "inventory.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lore {

namespace {

using nlohmann::json;

/// The text of a member, or "".
std::string text_of(json const& entity, char const* key) {
    auto const found = entity.find(key);
    return found != entity.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string id_in(json const& entity, char const* key) {
    auto const found = entity.find(key);
    return found != entity.end() && found->is_object() ? text_of(*found, "@id") : "";
}

bool has_type(json const& entity, std::string_view type) {
    auto const found = entity.find("@type");
    if (found == entity.end()) return false;
    if (found->is_array()) return std::find(found->begin(), found->end(), json(type)) != found->end();
    return *found == json(type);
}

/// The path of a relative URI; nothing where its percent signs are none.
std::optional<std::string> path_of(std::string_view id) {
    std::string path;
    for (std::size_t i = 0; i < id.size(); ++i) {
        if (id[i] != '%') {
            path += id[i];
            continue;
        }
        unsigned value = 0;
        char const* const digits = id.data() + i + 1;
        if (i + 2 >= id.size() || std::from_chars(digits, digits + 2, value, 16).ptr != digits + 2) return std::nullopt;
        path += static_cast<char>(value);
        i += 2;
    }
    return path;
}

/// Lengths are texts in RO-Crate; numbers are understood too.
std::optional<std::uint64_t> length_of(json const& entity) {
    auto const found = entity.find("contentSize");
    if (found == entity.end()) return std::nullopt;
    if (!found->is_string() && !found->is_number()) return std::nullopt;
    std::string const digits = found->is_string() ? found->get<std::string>() : found->dump();
    std::uint64_t bytes = 0;
    auto const [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), bytes);
    if (failed != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    return bytes;
}

/// An absolute URI has a scheme before any other ':' could come.
bool is_absolute(std::string_view id) { return id.substr(0, id.find('/')).find(':') != std::string_view::npos; }

void add_file(json const& entity, CrateDescription& crate) {
    std::string const id = text_of(entity, "@id");
    if (is_absolute(id)) return;
    bool const left_out = id.starts_with('#');
    if (left_out && !entity.contains("localPath")) return;
    auto const path = left_out ? std::optional{text_of(entity, "localPath")} : path_of(id);
    if (!path || !is_safe_path(*path)) {
        crate.defects.push_back(
            fmt::format("{}: it describes a file by '{}', which is no path in it", crate_file, json(id).dump()));
        return;
    }
    (left_out ? crate.left_out : crate.files).push_back({*path, length_of(entity), text_of(entity, "sha256")});
}

void check_root(json const& root, CrateDescription& crate) {
    crate.title = text_of(root, "name");
    for (char const* const key : {"name", "description", "datePublished"})
        if (text_of(root, key).empty())
            crate.defects.push_back(fmt::format("{}: its root has no '{}'", crate_file, key));
    if (!root.contains("license")) crate.defects.push_back(fmt::format("{}: its root has no 'license'", crate_file));
    if (!has_type(root, "Dataset")) crate.defects.push_back(fmt::format("{}: its root is no Dataset", crate_file));
}

}   // namespace

CrateDescription read_crate(std::string const& text) {
    CrateDescription crate;
    json const document = json::parse(text, nullptr, false);
    if (document.is_discarded() || !document.is_object() || !document.contains("@graph") ||
        !document["@graph"].is_array()) {
        crate.defects.push_back(fmt::format("{}: it is no JSON document with a '@graph'", crate_file));
        return crate;
    }
    std::string root;
    for (json const& entity : document["@graph"]) {
        if (!entity.is_object()) continue;
        if (text_of(entity, "@id") == crate_file) {
            root = id_in(entity, "about");
            if (!id_in(entity, "conformsTo").starts_with("https://w3id.org/ro/crate/1."))
                crate.defects.push_back(fmt::format("{}: it does not say that it is RO-Crate 1", crate_file));
        }
        if (has_type(entity, "File")) add_file(entity, crate);
    }
    auto const& graph = document["@graph"];
    auto const described = std::find_if(graph.begin(), graph.end(), [&](json const& entity) {
        return !root.empty() && entity.is_object() && text_of(entity, "@id") == root;
    });
    if (described == graph.end()) crate.defects.push_back(fmt::format("{}: it describes no root", crate_file));
    else check_root(*described, crate);
    return crate;
}

}   // namespace lore
