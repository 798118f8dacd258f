# cmake --install: programs with manual pages and completion, jobs, headers, the library for CMake and pkg-config.
include(CMakePackageConfigHelpers)

# The library: find_package(Lore) and Lore::lore, or pkg-config lore.
get_property(modules GLOBAL PROPERTY LORE_MODULES)
set_target_properties(lore PROPERTIES EXPORT_NAME lore)
set_target_properties(lore_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS lore lore_flags ${modules} EXPORT LoreTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT LoreTargets NAMESPACE Lore:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Lore)
install(DIRECTORY include/lore DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")

configure_package_config_file(tools/cmake/LoreConfig.cmake.in ${PROJECT_BINARY_DIR}/LoreConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Lore)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/LoreConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/LoreConfig.cmake ${PROJECT_BINARY_DIR}/LoreConfigVersion.cmake
  tools/cmake/LoreDependencies.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Lore)

# A linker takes static libraries from the user's to the used: the highest level first.
set(LORE_PC_LIBRARIES "")
foreach(module ${modules})
  get_target_property(type ${module} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    string(PREPEND LORE_PC_LIBRARIES "-l${module} ")
  endif()
endforeach()
list(JOIN MPI_CXX_LIBRARIES " " mpi_libraries)
string(APPEND LORE_PC_LIBRARIES "-lboost_serialization ${mpi_libraries} -pthread -ldl")
set(LORE_PC_REQUIRES "fmt tomlplusplus libzstd libxxhash liblz4 zlib librsvg-2.0 cairo libarchive nettle")
file(RELATIVE_PATH LORE_PC_INCLUDES ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
configure_file(tools/package/lore.pc.in ${PROJECT_BINARY_DIR}/lore.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lore.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# What is run and copied. install-deps and the old names below jobs/ belong to the clone.
install(DIRECTORY jobs/batch jobs/campaigns jobs/tasks DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/jobs
  USE_SOURCE_PERMISSIONS)
install(PROGRAMS jobs/quickstart DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/jobs)
install(DIRECTORY docs/examples/pendulum docs/examples/pusher docs/examples/runner docs/examples/newcomers
  DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/examples
  FILES_MATCHING PATTERN "*.c" PATTERN "*.cpp" PATTERN "*.toml" PATTERN CMakeLists.txt)
# With the module that serves it: the folder can be copied.
install(DIRECTORY docs/examples/cartpole DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/examples
  FILES_MATCHING PATTERN "cartpole.py" PATTERN "*.toml")
install(FILES tools/python/lore_world.py DESTINATION ${CMAKE_INSTALL_DATADIR}/lore/examples/cartpole)

# Completion: bash looks for a file of the command's name, zsh for the first line of all files.
set(LORE_BASH_COMPLETIONS ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  CACHE STRING "Where bash finds completions")
set(LORE_ZSH_COMPLETIONS ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Where zsh finds completions")
foreach(program lore lore-evolve lore-kb lore-replay lore-campaign lore-world)
  install(FILES tools/package/completion/lore.bash DESTINATION ${LORE_BASH_COMPLETIONS} RENAME ${program})
endforeach()
install(FILES tools/package/completion/_lore DESTINATION ${LORE_ZSH_COMPLETIONS})

# `manual-pages` asks the programs for their help; those pages that were made are installed.
find_program(LORE_HELP2MAN help2man)
if(LORE_HELP2MAN)
  add_custom_target(manual-pages COMMAND ${PROJECT_SOURCE_DIR}/tools/package/manual-pages ${PROJECT_BINARY_DIR}/bin
    ${PROJECT_BINARY_DIR}/man VERBATIM)
  add_dependencies(manual-pages programs)
endif()
install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL
  FILES_MATCHING PATTERN "*.1")
