#include <lore/archive/genome_file.h>

#include "boost_types.h"

namespace lore {

namespace {

constexpr std::size_t longest_reason = 65536;

}   // namespace

void write_genome(std::string const& path, FailedIndividual const& failed) {
    write_container(path, FileKind::genome, write_with_boost([&](OutArchive& archive) {
                        std::int32_t const rank = failed.rank;
                        std::vector<char> const reason(failed.reason.begin(), failed.reason.end());
                        archive << failed.id << failed.genome << rank;
                        put_blob(archive, reason);
                    }));
}

FailedIndividual read_genome(std::string const& path) {
    FailedIndividual failed;
    read_with_boost(read_container(path, FileKind::genome), path, [&](InArchive& archive) {
        std::int32_t rank = 0;
        std::vector<char> reason;
        archive >> failed.id >> failed.genome >> rank;
        get_blob(archive, reason, longest_reason);
        failed.rank = rank;
        failed.reason.assign(reason.begin(), reason.end());
    });
    return failed;
}

}   // namespace lore
