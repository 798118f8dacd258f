# How a module and a program of Lore are declared; one place for flags that decide results.

set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(lore_flags INTERFACE)
target_compile_features(lore_flags INTERFACE cxx_std_20)
# Templates for floats and vectors join conditions by &, the only form that vectors know; clang warns of it for bools.
target_compile_options(lore_flags INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
# Results are equal to the bit on every compiler and processor only if no multiplication is fused with an addition.
target_compile_options(lore_flags INTERFACE -ffp-contract=off -Wno-psabi $<BUILD_INTERFACE:-Wall>
  $<BUILD_INTERFACE:-Wextra>
  $<BUILD_INTERFACE:-Wpedantic>)
target_include_directories(lore_flags INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# lore_module(NAME core SOURCES a.cpp PUBLIC lore_x PRIVATE foreign)
function(lore_module)
  cmake_parse_arguments(MODULE "" "NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target lore_${MODULE_NAME})
  if(MODULE_SOURCES)
    add_library(${target} STATIC ${MODULE_SOURCES})
    target_link_libraries(${target} PUBLIC lore_flags ${MODULE_PUBLIC} PRIVATE ${MODULE_PRIVATE})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${MODULE_NAME})
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE lore_flags ${MODULE_PUBLIC})
  endif()
  set_property(GLOBAL APPEND PROPERTY LORE_MODULES ${target})
endfunction()

# lore_kernel(episode lanes_kernel.cpp): compiles the source into module lore_episode once per instruction set.
#
# Inside it LORE_ISA_NAMESPACE names the namespace (isa_baseline, isa_v3, isa_v4) and LORE_LANES the native width in
# floats. A kernel source must not include headers with inline functions that other files use too (the standard
# containers, std::function): the linker keeps one copy of each, and it might be the one for the larger set. Take
# pointers and plain structs; mark own helpers always_inline or static.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
  set(LORE_ISAS baseline v3 v4)
else()
  set(LORE_ISAS baseline)
endif()
set(LORE_ISA_FLAGS_v3 -march=x86-64-v3)
set(LORE_ISA_FLAGS_v4 -march=x86-64-v4 -mprefer-vector-width=512)
set(LORE_ISA_LANES_baseline 4)
set(LORE_ISA_LANES_v3 8)
set(LORE_ISA_LANES_v4 16)
list(LENGTH LORE_ISAS LORE_ISA_COUNT)
target_compile_definitions(lore_flags INTERFACE $<BUILD_INTERFACE:LORE_ISA_COUNT=${LORE_ISA_COUNT}>)

function(lore_kernel module source)
  get_filename_component(stem ${source} NAME_WE)
  foreach(isa ${LORE_ISAS})
    set(objects lore_${module}_${stem}_${isa})
    add_library(${objects} OBJECT ${source})
    target_link_libraries(${objects} PRIVATE lore_flags)
    # Where in a cache line a kernel lies decides 3 % of its time: always in the same place, whatever it is linked with.
    target_compile_options(${objects} PRIVATE ${LORE_ISA_FLAGS_${isa}} -falign-functions=64 -falign-loops=32)
    target_compile_definitions(${objects} PRIVATE LORE_ISA_NAMESPACE=isa_${isa} LORE_LANES=${LORE_ISA_LANES_${isa}})
    set_target_properties(${objects} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_sources(lore_${module} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
