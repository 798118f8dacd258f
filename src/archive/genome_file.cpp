#include <lore/archive/genome_file.h>

#include "boost_types.h"

namespace lore {

namespace {

constexpr std::size_t longest_reason = 65536;

}   // namespace

void write_genome(std::string const& path, FailedIndividual const& failed) {
    write_container(path, FileKind::genome, write_with_boost([&](OutArchive& archive) {
                        std::int32_t const rank = failed.rank;
                        put_world(archive, failed.world);
                        archive << failed.id << failed.genome << rank;
                        put_text(archive, failed.reason);
                    }));
}

FailedIndividual read_genome(std::string const& path) {
    return unpack_genome(read_container(path, FileKind::genome), path);
}

FailedIndividual unpack_genome(Payload const& payload, std::string_view name) {
    FailedIndividual failed;
    read_with_boost(payload, name, [&](InArchive& archive) {
        failed.world = get_world(archive);
        std::int32_t rank = 0;
        archive >> failed.id >> failed.genome >> rank;
        failed.rank = rank;
        failed.reason = get_text(archive, longest_reason);
    });
    return failed;
}

}   // namespace lore
