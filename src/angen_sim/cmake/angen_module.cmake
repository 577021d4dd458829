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
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${view}/${name} SYMBOLIC)
  if(arg_SOURCES)
    add_library(angen_${name} SHARED ${arg_SOURCES})
    set(scope PUBLIC)
    if(ANGEN_PRECOMPILER STREQUAL "angen_${name}" OR arg_PRECOMPILE)
      angen_compile_options(angen_${name} PRECOMPILE ${arg_PRECOMPILE})
    elseif(arg_PRECOMPILED_BY)
      angen_compile_options(angen_${name} angen_${arg_PRECOMPILED_BY})
    else()
      angen_compile_options(angen_${name} ${ANGEN_PRECOMPILER})
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
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}/angen
          FILES_MATCHING PATTERN "*.h")
endfunction()

# angen_loaded_by_name(TARGET): a library that a running building loads.
function(angen_loaded_by_name target)
  if(TARGET angen_run)
    add_dependencies(angen_run ${target})
    add_dependencies(angen_plugins ${target})
  endif()
endfunction()

# angen_imported(modules...): targets of the modules of angen_sim, in a package that is built by itself. There are no
# walls then.
function(angen_imported)
  foreach(module ${ARGN})
    if(NOT TARGET angen_${module})
      find_library(ANGEN_${module}_LIBRARY angen_${module} HINTS ${angen_sim_DIR}/../../../lib)
      add_library(angen_${module} INTERFACE IMPORTED GLOBAL)
      target_include_directories(angen_${module} INTERFACE ${angen_sim_INCLUDE_DIRS})
      target_link_libraries(angen_${module} INTERFACE ${angen_sim_LIBRARIES} Eigen3::Eigen)
      if(ANGEN_${module}_LIBRARY)  # or it has only headers
        target_link_libraries(angen_${module} INTERFACE ${ANGEN_${module}_LIBRARY})
      endif()
    endif()
  endforeach()
endfunction()

# angen_plugin(FILE sources...): a plug-in library libFILE.so, loaded by name and never linked to.
function(angen_plugin file)
  add_library(${file} MODULE ${ARGN})
  angen_compile_options(${file} ${ANGEN_PRECOMPILER})
  set_target_properties(${file} PROPERTIES UNITY_BUILD OFF)  # few sources each
  angen_loaded_by_name(${file})
  target_link_libraries(${file} PRIVATE angen_plugin angen_class_loader)
  # A function that is missing is found when the library is linked or loaded, not in the middle of a run; and a
  # class is the library's own, also when another library has one of the same name.
  target_link_options(${file} PRIVATE -Wl,-z,now -Wl,-Bsymbolic)
  if(NOT ANGEN_FUZZ)  # the functions of clang's sanitizers are in the program
    target_link_options(${file} PRIVATE -Wl,-z,defs)
  endif()
  install(TARGETS ${file} LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  add_custom_command(TARGET ${file} POST_BUILD COMMAND ${ANGEN_DESCRIBE} $<TARGET_FILE:${file}>)
  install(FILES ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/lib${file}.json
          DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION} OPTIONAL)
endfunction()

# angen_plugin_folder(NAME more sources... [USES modules...]): the plug-in libraries of one folder. A source that begins with the line
# `// libX.so` is, with all others that begin so, the plug-in library X; further names on this line, or on a second one,
# are links to it. What no library has is what they share: the module angen_NAME.
function(angen_plugin_folder name)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp */*.cpp)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES")
  set(shared ${arg_UNPARSED_ARGUMENTS})
  set(libraries)
  foreach(source ${sources})
    file(STRINGS ${source} names REGEX "^// lib[a-z0-9_]+\\.so( lib[a-z0-9_]+\\.so)*$")
    if(NOT names)
      list(APPEND shared ${source})
      continue()
    endif()
    string(REGEX MATCHALL "lib[a-z0-9_]+\\.so" names "${names}")
    list(POP_FRONT names library)
    string(REGEX REPLACE "^lib|\\.so$" "" library ${library})
    list(APPEND libraries ${library})
    list(APPEND sources_of_${library} ${source})
    list(APPEND links_of_${library} ${names})
  endforeach()
  angen_module(${name} SOURCES ${shared} USES plugin ${arg_USES})
  list(REMOVE_DUPLICATES libraries)
  foreach(library ${libraries})
    angen_plugin(${library} ${sources_of_${library}})
    target_link_libraries(${library} PRIVATE angen_${name})
    foreach(link ${links_of_${library}})
      set(link ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${link})
      add_custom_command(TARGET ${library} POST_BUILD
        COMMAND ${CMAKE_COMMAND} -E create_symlink lib${library}.so ${link})
      install(FILES ${link} DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
    endforeach()
  endforeach()
endfunction()
