# How a module and a program of Lore are declared; one place for flags that decide results.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_library(lore_flags INTERFACE)
# Results are equal to the bit on every compiler and processor only if no multiplication is fused with an addition.
target_compile_options(lore_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wno-psabi)
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
