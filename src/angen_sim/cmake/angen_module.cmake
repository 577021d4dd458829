# angen_module(NAME [SOURCES files...] [HEADERS_ONLY] [USES modules...] [LINK libraries...]
#              [PRECOMPILE headers of others... | PRECOMPILED_BY module])
# One folder, one shared library angen_NAME of its sources: all but those with a main(), which are called main.cpp or
# *_main.cpp, unless SOURCES names some. It sees its own headers and those of the modules it uses, and no others: each
# module's headers are reached through a link of its own, so a wrong include does not build.
function(angen_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "HEADERS_ONLY" "PRECOMPILED_BY" "SOURCES;USES;LINK;PRECOMPILE")
  if(NOT arg_SOURCES AND NOT arg_HEADERS_ONLY)
    file(GLOB arg_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    list(FILTER arg_SOURCES EXCLUDE REGEX "/(.*_)?main\\.cpp$")
  endif()
  set(view ${CMAKE_BINARY_DIR}/angen_headers/${name})
  file(MAKE_DIRECTORY ${view})
  file(CREATE_LINK ${ANGEN_SIM_DIR}/${name} ${view}/${name} SYMBOLIC)
  if(arg_SOURCES)
    add_library(angen_${name} SHARED ${arg_SOURCES})
    set(scope PUBLIC)
    if(name STREQUAL "core" OR arg_PRECOMPILE)
      angen_compile_options(angen_${name} PRECOMPILE ${arg_PRECOMPILE})
    elseif(arg_PRECOMPILED_BY)
      angen_compile_options(angen_${name} angen_${arg_PRECOMPILED_BY})
    else()
      angen_compile_options(angen_${name} angen_core)
    endif()
    install(TARGETS angen_${name} LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  else()
    add_library(angen_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(angen_${name} ${scope} ${view})
  foreach(used ${arg_USES})
    target_link_libraries(angen_${name} ${scope} angen_${used})
  endforeach()
  target_link_libraries(angen_${name} ${scope} ${arg_LINK})
  install(DIRECTORY ${ANGEN_SIM_DIR}/${name} DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION}/..
          FILES_MATCHING PATTERN "*.h")
endfunction()

# angen_plugin(FILE sources...): a plug-in library libFILE.so, loaded by name and never linked to.
function(angen_plugin file)
  add_library(${file} MODULE ${ARGN})
  angen_compile_options(${file} angen_core)
  set_target_properties(${file} PROPERTIES UNITY_BUILD OFF)  # few sources each
  add_dependencies(angen_run ${file})
  add_dependencies(angen_plugins ${file})
  target_link_libraries(${file} PRIVATE angen_plugin angen_class_loader)
  # A function that is missing is found when the library is linked or loaded, not in the middle of a run; and a
  # class is the library's own, also when another library has one of the same name.
  target_link_options(${file} PRIVATE -Wl,-z,now -Wl,-Bsymbolic)
  if(NOT ANGEN_FUZZ)  # the functions of clang's sanitizers are in the program
    target_link_options(${file} PRIVATE -Wl,-z,defs)
  endif()
  install(TARGETS ${file} LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  add_custom_command(TARGET ${file} POST_BUILD COMMAND angen_describe $<TARGET_FILE:${file}>)
  install(FILES ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/lib${file}.json
          DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION} OPTIONAL)
endfunction()
