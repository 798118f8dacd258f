# What Lore's libraries need, found once, by Lore and by those who link them. docs/design/architecture.md says where
# each enters.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(rsvg REQUIRED IMPORTED_TARGET librsvg-2.0 cairo)
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)   # FLANN's only need
pkg_check_modules(libarchive REQUIRED IMPORTED_TARGET libarchive)
pkg_check_modules(nettle REQUIRED IMPORTED_TARGET nettle)
find_package(ZLIB REQUIRED)
find_package(Boost 1.74 REQUIRED COMPONENTS serialization)
find_package(MPI REQUIRED COMPONENTS CXX)
