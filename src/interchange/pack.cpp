#include <lore/interchange/pack.h>

#include "archive_file.h"
#include "crate.h"
#include "inventory.h"

#include <lore/archive/atomic_file.h>
#include <lore/campaign/state.h>
#include <lore/core/directory.h>
#include <lore/core/error.h>
#include <lore/core/file.h>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace lore {

namespace {

namespace fs = std::filesystem;

/// Files that would change while they are read, and runs that the plan does not describe.
void refuse_what_cannot_be_told(CampaignPlan const& plan, CampaignDirectory const& directory) {
    std::error_code ignored;   // what cannot be looked at is as good as not there
    if (!fs::is_directory(directory.path(), ignored))
        throw UsageError(fmt::format("there is nothing to pack in {}", directory.path()), "no such directory",
                         "Start with 'lore-campaign run', or check --dir.");
    for (Step const& step : steps_of(plan)) {
        StepState const state = state_of(plan, directory, step);
        if (state.status == StepStatus::running)
            throw Error(fmt::format("cannot pack {}", directory.path()), fmt::format("{} is at work", step.name),
                        "Wait for it, or stop it, and pack then.");
        if (state.other)
            throw UsageError(fmt::format("cannot pack {} as {}", directory.path(), plan.path),
                             fmt::format("{}: {}", step.name, state.reason),
                             "Give the campaign that it was made with.");
    }
}

/// A pack in whole: its files, and the two that describe them.
struct Pack {
    Inventory inventory;
    std::string crate, sums;
};

Pack gathered(CampaignPlan const& plan, CampaignDirectory const& directory, PackOptions const& options,
              Pulse const& pulse) {
    refuse_what_cannot_be_told(plan, directory);
    Pack pack;
    pack.inventory = take_inventory(plan, directory, options.leave_out, pulse);
    pack.crate = crate_json(plan, directory, pack.inventory, options);
    std::vector<PackedFile> all = pack.inventory.files;
    all.push_back({std::string{crate_file}, "", pack.crate.size(), sha256_of(pack.crate)});
    pack.sums = sums_text(all);
    return pack;
}

PackCounts counts_of(Pack const& pack) {
    PackCounts counts{pack.inventory.files.size(), pack.inventory.left_out.size(), 0};
    for (PackedFile const& file : pack.inventory.files) counts.bytes += file.bytes;
    return counts;
}

void add_text(ArchiveWriter& archive, std::string_view name, std::string const& text) {
    archive.begin(std::string{name}, text.size());
    archive.write(std::as_bytes(std::span{text.data(), text.size()}));
}

void add_file(ArchiveWriter& archive, PackedFile const& file, Pulse const& pulse) {
    Error const changed(fmt::format("cannot pack {}", file.source), "it has changed meanwhile",
                        "Pack once nothing writes there any more.");
    archive.begin(file.path, file.bytes, file.executable);
    std::uint64_t room = file.bytes;
    FileSum const sum = read_in_pieces(file.source, pulse, [&](std::span<std::byte const> bytes) {
        if (bytes.size() > room) throw changed;
        room -= bytes.size();
        archive.write(bytes);
    });
    if (room > 0 || sum.sha256 != file.sha256) throw changed;
}

bool lies_in(std::string const& path, std::string const& directory) {
    fs::path const relative =
        fs::absolute(path).lexically_normal().lexically_relative(fs::absolute(directory + "/").lexically_normal());
    return !relative.empty() && *relative.begin() != "..";
}

bool are_the_same(std::string const& file, std::string const& other) {
    std::error_code failed;
    bool const same = fs::equivalent(file, other, failed);
    if (failed) throw file_error("read", other, failed.value());
    return same;
}

/// What a former description has in inputs/ and this one has not; never a file that this one is made from.
void remove_former_inputs(CampaignDirectory const& directory, std::vector<PackedFile> const& files) {
    for (DirectoryEntry const& entry : entries_below(directory.file(inputs_folder))) {
        auto const needed = [&](PackedFile const& file) {
            return directory.file(file.path) == entry.path || are_the_same(file.source, entry.path);
        };
        if (entry.type != fs::file_type::directory && std::none_of(files.begin(), files.end(), needed))
            remove_file(entry.path);
    }
}

void copy_permissions(std::string const& from, std::string const& to) {
    std::error_code failed;
    fs::perms const permissions = fs::status(from, failed).permissions();
    if (failed) throw file_error("read", from, failed.value());
    fs::permissions(to, permissions, failed);
    if (failed) throw file_error("write", to, failed.value());
}

}   // namespace

PackCounts pack_campaign(CampaignPlan const& plan, CampaignDirectory const& directory, PackOptions const& options,
                         std::string const& out, Pulse const& pulse) {
    if (lies_in(out, directory.path()))
        throw UsageError(fmt::format("cannot write {}", out), "it would be a part of what it packs",
                         "Choose a place outside of the campaign's directory.");
    ArchiveWriter archive{out};   // first: what is wrong with the name is said before hours of reading
    Pack const pack = gathered(plan, directory, options, pulse);
    add_text(archive, crate_file, pack.crate);
    add_text(archive, sums_file, pack.sums);
    for (PackedFile const& file : pack.inventory.files) add_file(archive, file, pulse);
    archive.close();
    return counts_of(pack);
}

PackCounts describe_campaign(CampaignPlan const& plan, CampaignDirectory const& directory, PackOptions const& options,
                             Pulse const& pulse) {
    if (!options.leave_out.empty())
        throw UsageError("nothing can be left out of the directory itself", "--leave-out is for archives",
                         "Give --out, or leave --leave-out out.");
    Pack const pack = gathered(plan, directory, options, pulse);
    for (PackedFile const& file : pack.inventory.files) {
        if (!file.path.starts_with(inputs_folder)) continue;
        make_directory(fs::path{directory.file(file.path)}.parent_path().string());
        write_file_atomically(directory.file(file.path), read_file(file.source));
        if (file.executable) copy_permissions(file.source, directory.file(file.path));
    }
    remove_former_inputs(directory, pack.inventory.files);
    write_file_atomically(directory.file(crate_file), std::string_view{pack.crate});
    write_file_atomically(directory.file(sums_file), std::string_view{pack.sums});
    return counts_of(pack);
}

}   // namespace lore
