# cmake --install: programs, headers, and find_package(Lore) with Lore::lore.
