# cmake --install: programs, headers, and find_package(Lore) with Lore::lore.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY LORE_MODULES)
set_target_properties(lore PROPERTIES EXPORT_NAME lore)
set_target_properties(lore_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS lore lore_flags ${modules} EXPORT LoreTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT LoreTargets NAMESPACE Lore:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Lore)
install(DIRECTORY include/lore DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY jobs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/jobs FILES_MATCHING PATTERN "*.toml" PATTERN
  "*.sbatch")

install(DIRECTORY docs/examples/pendulum docs/examples/maze docs/examples/pusher docs/examples/runner
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/examples FILES_MATCHING PATTERN "*.c" PATTERN "*.cpp" PATTERN "*.toml")
# With the module that serves it: the folder can be copied.
install(FILES docs/examples/cartpole/cartpole.py docs/examples/cartpole/source.toml docs/examples/cartpole/target.toml
  tools/python/lore_world.py DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/examples/cartpole)

configure_package_config_file(tools/cmake/LoreConfig.cmake.in ${PROJECT_BINARY_DIR}/LoreConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Lore)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/LoreConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/LoreConfig.cmake ${PROJECT_BINARY_DIR}/LoreConfigVersion.cmake
  tools/cmake/LoreDependencies.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Lore)
