#include <lore/experiment/version.h>

#include "build_data.h"

#include <lore/cluster/session.h>
#include <lore/core/isa.h>

#include <fmt/format.h>

namespace lore {

BuildInformation build_information() {
#if defined(__clang__)
    std::string const compiler = fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    std::string const compiler = fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    std::string const compiler = "unknown compiler";
#endif
    BuildInformation build{build_data::version, build_data::commit, compiler, build_data::build_type, {}};
    auto const [mpi, mpi_version] = mpi_library();
    build.libraries.emplace_back(mpi, mpi_version);
    for (auto const& [library, version] : build_data::libraries) build.libraries.emplace_back(library, version);
    return build;
}

std::string version_text(std::string_view program) {
    BuildInformation const build = build_information();
    Isa const isa = active_isa();
    std::string text = fmt::format(
        "{} {} (commit {})\ncompiled by {}, {}\ninstruction set {} ({} floats a vector; detected {})\n", program,
        build.version, build.commit, build.compiler, build.build_type, name(isa), lanes_of(isa), name(detected_isa()));
    for (auto const& [library, version] : build.libraries) text += fmt::format("{} {}\n", library, version);
    text.pop_back();
    return text;
}

}   // namespace lore
