#include "crate.h"

#include <lore/core/error.h>
#include <lore/core/uri.h>
#include <lore/experiment/version.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <utility>

#include <fmt/format.h>

namespace lore {

namespace {

constexpr char root_id[] = "./", base_profile[] = "https://w3id.org/ro/crate/1.2",
               run_profile[] = "https://w3id.org/ro/wfrun/process/0.5";

/// What files are, by their name or its ending.
struct FileWords {
    std::string_view ending, format, description;
};
constexpr std::array file_words{
    FileWords{"/config.toml", "application/toml", "every setting of the run, with meaning and unit"},
    FileWords{"/arena.toml", "application/toml", "the arena of the run"},
    FileWords{"/manifest.json", "application/json",
              "provenance of the run: build, sessions, inputs, outputs, signature"},
    FileWords{"/progress.csv", "text/csv", "a row a generation"},
    FileWords{"/lineage.lore", "application/octet-stream", "all ancestors of the last population"},
    FileWords{"/all.lore", "application/octet-stream", "every individual ever evaluated"},
    FileWords{"/checkpoint.lore", "application/octet-stream", "what the run continues from"},
    FileWords{"/checkpoint-older.lore", "application/octet-stream", "the checkpoint before the last"},
    FileWords{"/choice.json", "application/json", "which source runs the knowledge bases come from"},
    FileWords{"/report.html", "text/html", "the report"},
    FileWords{".lorekb", "application/octet-stream", "knowledge base"},
    FileWords{".lore", "application/octet-stream", "file of Lore"},
    FileWords{".csv", "text/csv", "table"},
    FileWords{".json", "application/json", "JSON document"},
    FileWords{".toml", "application/toml", "configuration"},
    FileWords{".so", "application/x-sharedlib", "shared library"},
    FileWords{".py", "text/x-python", "program in Python"},
    FileWords{".svg", "image/svg+xml", "figure"},
    FileWords{".png", "image/png", "figure"},
    FileWords{".html", "text/html", "page"},
    FileWords{".log", "text/plain", "output of a step"},
    FileWords{".txt", "text/plain", "text"},
    FileWords{"", "application/octet-stream", "file of the campaign"},
};

FileWords words_for(std::string_view path) {
    std::string const rooted = "/" + std::string{path};
    return *std::find_if(file_words.begin(), file_words.end(),
                         [&](FileWords const& words) { return rooted.ends_with(words.ending); });
}

Json file_entity(PackedFile const& file, std::string const& id) {
    FileWords const words = words_for(file.path);
    return {{"@id", id},
            {"@type", "File"},
            {"name", file.path},
            {"description", words.description},
            {"encodingFormat", words.format},
            {"contentSize", std::to_string(file.bytes)},
            {"sha256", file.sha256}};
}

Json left_out_entity(PackedFile const& file) {
    Json entity = file_entity(file, left_out_id(file.path));
    entity["localPath"] = file.path;
    entity["description"] = fmt::format("left out of this archive ({}): {}", name(*part_of(file.path)),
                                        entity["description"].get<std::string>());
    return entity;
}

/// "" is the root.
std::string folder_of(std::string_view path) {
    std::string_view const whole = path.ends_with('/') ? path.substr(0, path.size() - 1) : path;
    return std::string{whole.substr(0, whole.rfind('/') + 1)};   // npos + 1 is 0
}

/// The entities of files and folders; each folder names what lies directly in it.
std::vector<Json> data_entities(Inventory const& inventory, Json& parts_of_root) {
    std::map<std::string, Json> parts;   // by folder
    std::vector<Json> entities;
    auto const add_part = [&](std::string path) {
        while (true) {
            std::string const folder = folder_of(path);
            bool const known = parts.contains(folder);
            parts[folder].push_back(reference_to(entity_id(path)));
            if (known || folder.empty()) return;
            path = folder;
        }
    };
    for (PackedFile const& file : inventory.files) {
        entities.push_back(file_entity(file, entity_id(file.path)));
        add_part(file.path);
    }
    for (auto& [folder, list] : parts) {
        if (folder.empty()) continue;
        entities.push_back({{"@id", entity_id(folder)},
                            {"@type", "Dataset"},
                            {"name", folder},
                            {"description", fmt::format("the folder {}", folder)},
                            {"hasPart", list}});
    }
    parts_of_root = parts[""];
    for (PackedFile const& file : inventory.left_out) {
        entities.push_back(left_out_entity(file));
        parts_of_root.push_back(reference_to(left_out_id(file.path)));
    }
    return entities;
}

Json license_of(std::string const& stated, std::vector<Json>& entities) {
    if (stated.empty()) return "No license is stated; ask the authors.";
    bool const is_url = stated.starts_with("https://") || stated.starts_with("http://");
    bool const is_identifier = std::all_of(stated.begin(), stated.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '.' || c == '-' || c == '+';
    });
    if (!is_url && !is_identifier) return stated;
    std::string const id = is_url ? stated : "https://spdx.org/licenses/" + stated;
    entities.push_back({{"@id", id},
                        {"@type", "CreativeWork"},
                        {"name", stated},
                        {"description", "License of the data of this campaign"},
                        {"url", id}});
    return reference_to(id);
}

/// Ids of those who are named "Ada Lovelace" or "Ada Lovelace <https://orcid.org/...>".
std::vector<std::string> add_authors(std::vector<std::string> const& authors, std::vector<Json>& entities) {
    std::vector<std::string> ids;
    for (std::string const& author : authors) {
        std::size_t const open = author.find(" <http");
        bool const has_id = open != std::string::npos && author.ends_with('>');
        std::string const id =
            has_id ? author.substr(open + 2, author.size() - open - 3) : fmt::format("#author-{}", ids.size() + 1);
        entities.push_back({{"@id", id}, {"@type", "Person"}, {"name", has_id ? author.substr(0, open) : author}});
        ids.push_back(id);
    }
    return ids;
}

std::string date_of(PackOptions const& options, CrateActions const& told) {
    std::string const& date = options.date.empty() ? told.last_day : options.date;
    constexpr std::string_view form = "0000-00-00";
    bool const fits = date.size() == form.size() &&
                      std::equal(date.begin(), date.end(), form.begin(), [](unsigned char c, char wanted) {
                          return wanted == '0' ? std::isdigit(c) != 0 : c == '-';
                      });
    auto const part = [&](std::size_t first, std::size_t count) { return std::stoi(date.substr(first, count)); };
    if (fits && std::chrono::year_month_day{std::chrono::year{part(0, 4)},
                                            std::chrono::month{static_cast<unsigned>(part(5, 2))},
                                            std::chrono::day{static_cast<unsigned>(part(8, 2))}}
                    .ok())
        return date;
    throw UsageError(options.date.empty() ? "no run says when it ended" : fmt::format("'{}' is no date", options.date),
                     "a pack has a date", "Give one with --date, as YYYY-MM-DD.");
}

std::string description_of(CampaignPlan const& plan, Inventory const& inventory, PackOptions const& options,
                           CrateActions const& told) {
    std::string text = options.description.empty() ? "" : options.description + " ";
    text += fmt::format("A campaign of Lore, evolution of robot controllers with knowledge from earlier runs: {} runs "
                        "planned, {} begun, {} finished; {} of {} knowledge bases made. Locks and temporary files are "
                        "not part of it.",
                        planned_runs(plan), told.runs, told.finished, told.bases, plan.knowledge.size());
    for (PackPart const part : {PackPart::individuals, PackPart::checkpoints, PackPart::bases, PackPart::logs}) {
        std::size_t files = 0;
        std::uint64_t bytes = 0;
        for (PackedFile const& file : inventory.left_out) {
            if (part_of(file.path) != part) continue;
            ++files;
            bytes += file.bytes;
        }
        if (files > 0) text += fmt::format(" Left out: {} ({} files, {} bytes).", name(part), files, bytes);
    }
    return text;
}

}   // namespace

std::string entity_id(std::string_view path) {
    // Letters of other scripts stay readable: an id may be an IRI.
    static std::string const also = [] {
        std::string bytes = "/";
        for (int byte = 0x80; byte <= 0xff; ++byte) bytes += static_cast<char>(byte);
        return bytes;
    }();
    return percent_encoded(path, also);
}

std::string left_out_id(std::string_view path) { return "#left-out/" + entity_id(path); }

Json reference_to(std::string_view id) { return {{"@id", id}}; }

std::string crate_json(CampaignPlan const& plan, CampaignDirectory const& directory, Inventory const& inventory,
                       PackOptions const& options) {
    std::vector<Json> context;
    std::vector<std::string> const authors = add_authors(options.authors, context);
    CrateActions told = crate_actions(plan, directory, inventory, authors);
    if (told.runs == 0)
        throw UsageError(fmt::format("there is nothing to pack in {}", directory.path()), "no run has begun",
                         "Start with 'lore-campaign run', or check --dir.");
    Json parts;
    std::vector<Json> data = data_entities(inventory, parts);
    parts.push_back(reference_to(std::string{sums_file}));
    Json root{{"@id", root_id},
              {"@type", "Dataset"},
              {"name", plan.title},
              {"description", description_of(plan, inventory, options, told)},
              {"datePublished", date_of(options, told)},
              {"license", license_of(options.license, context)},
              {"conformsTo", reference_to(run_profile)}};
    for (std::string const& author : authors) root["author"].push_back(reference_to(author));
    for (std::string const& action : told.ids) root["mentions"].push_back(reference_to(action));
    root["hasPart"] = parts;

    BuildInformation const build = build_information();
    Json graph{{{"@id", crate_file},
                {"@type", "CreativeWork"},
                {"description", fmt::format("Written by lore-campaign {} (commit {})", build.version, build.commit)},
                {"about", reference_to(root_id)},
                {"conformsTo", reference_to(base_profile)}},
               root,
               {{"@id", run_profile},
                {"@type", Json::array({"CreativeWork", "Profile"})},
                {"name", "Process Run Crate"},
                {"version", "0.5"}}};
    for (std::vector<Json>* const list : {&context, &told.entities, &data})
        for (Json& entity : *list) graph.push_back(std::move(entity));
    graph.push_back({{"@id", sums_file},
                     {"@type", "File"},
                     {"name", sums_file},
                     {"description", "SHA-256 of every other file, for sha256sum -c"},
                     {"encodingFormat", "text/plain"}});
    Json const document{{"@context", std::string{base_profile} + "/context"}, {"@graph", graph}};
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}   // namespace lore
