# Headers take most of the compile time; two ways to read them less often take two thirds off a build. With
# -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON each source is compiled by itself, which finds a
# missing #include (`./angen tidy` does so).
# One: the sources of a target are compiled eight at a time, so a name in an unnamed namespace is unique in its target.
# Two: headers of others are parsed once. Never our own: the walls between modules hold, and GCC knows a file with
# #pragma once by its time, which a compiler cache that is shared by two checkouts gets wrong.
# angen_compile_settings(TARGET): the settings of a package whose TARGET precompiles the headers for the others.
macro(angen_compile_settings target)
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set(CMAKE_UNITY_BUILD ON)
  endif()
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
  # Warnings are errors in the build of a checkout only. GCC 12 takes the move of a std::variant for an uninitialized
  # read at -O3, catkin's Release.
  set(ANGEN_WARNINGS -Wall -Wextra $<$<BOOL:${ANGEN_WERROR}>:-Werror> -Wno-maybe-uninitialized)
  set(ANGEN_PRECOMPILER ${target})
  set(ANGEN_PRECOMPILED_HEADERS
    <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <set> <sstream> <string>
    <unordered_map> <utility> <variant> <vector> <Eigen/Geometry>)
endmacro()

# angen_compile_options(TARGET [OWNER | PRECOMPILE HEADERS...]): our warnings, and the headers that were precompiled for
# OWNER, a target with the same compiler flags; without OWNER, TARGET precompiles them itself, with HEADERS.
function(angen_compile_options target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PRECOMPILE")
  # GCC warns of classes with members of unnamed namespaces: harmless where each source is compiled by itself.
  target_compile_options(${target} PRIVATE ${ANGEN_WARNINGS} -Wno-subobject-linkage)
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "")  # it would be a flag of its own
  if(arg_UNPARSED_ARGUMENTS)
    target_precompile_headers(${target} REUSE_FROM ${arg_UNPARSED_ARGUMENTS})
  else()
    target_precompile_headers(${target} PRIVATE ${ANGEN_PRECOMPILED_HEADERS} ${arg_PRECOMPILE})
  endif()
endfunction()
