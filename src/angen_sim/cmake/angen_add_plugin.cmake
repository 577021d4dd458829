# angen_add_plugin(NAME sources...): a plug-in library libNAME.so for Angen, in the caller's own package.
# Comes with find_package(angen_sim); see docs/plugins.md.
find_package(Eigen3 REQUIRED NO_MODULE)
# <plugin/register.h> and others are in the sources, or in include/angen/ of an installation, not beside ROS's headers.
if(angen_sim_SOURCE_PREFIX)
  list(APPEND angen_sim_INCLUDE_DIRS ${angen_sim_SOURCE_PREFIX})
else()
  # below share/ of an installation, or below lib/ARCHITECTURE/ of Debian's package
  find_path(ANGEN_HEADERS plugin/register.h
    HINTS ${angen_sim_DIR}/../../../include/angen ${angen_sim_DIR}/../../../../include/angen REQUIRED)
  list(APPEND angen_sim_INCLUDE_DIRS ${ANGEN_HEADERS})
endif()
if(TARGET angen_ros)  # in one workspace with Angen, which is not built yet
  set(ANGEN_DESCRIBE angen_describe)
  set(ANGEN_ROS_LIBRARY angen_ros)
else()
  find_program(ANGEN_DESCRIBE angen_describe HINTS ${angen_sim_DIR}/../../../lib/angen_sim
    ${angen_sim_DIR}/../../../angen_sim REQUIRED)
  find_library(ANGEN_ROS_LIBRARY angen_ros HINTS ${angen_sim_DIR}/../../../lib REQUIRED)
endif()

function(angen_add_library name)
  add_library(${name} MODULE ${ARGN})
  target_compile_features(${name} PRIVATE cxx_std_17)
  target_include_directories(${name} SYSTEM PRIVATE ${angen_sim_INCLUDE_DIRS})
  # A function that is missing is found when the library is linked or loaded, not in the middle of a run; and a
  # class is the library's own, also when another library has one of the same name.
  target_link_options(${name} PRIVATE -Wl,--as-needed -Wl,-z,defs -Wl,-z,now -Wl,-Bsymbolic)
  target_link_libraries(${name} PRIVATE ${angen_sim_LIBRARIES} angen_class_loader Eigen3::Eigen)
endfunction()

function(angen_add_plugin name)
  angen_add_library(${name} ${ARGN})
  # The catalog file beside it, for the help and completion of the angen command.
  add_custom_command(TARGET ${name} POST_BUILD COMMAND ${ANGEN_DESCRIBE} $<TARGET_FILE:${name}>)
endfunction()

# angen_add_ros_kinds(NAME sources...): libNAME_ros.so, the ROS interface of the kinds in libNAME.so:
# their messages, how these are filled, how rviz shows them, and controllers of joints. Angen's node loads it by its name.
function(angen_add_ros_kinds name)
  angen_add_library(${name}_ros ${ARGN})
  target_include_directories(${name}_ros SYSTEM PRIVATE ${catkin_INCLUDE_DIRS} ${CATKIN_DEVEL_PREFIX}/include)
  target_link_libraries(${name}_ros PRIVATE ${ANGEN_ROS_LIBRARY} ${catkin_LIBRARIES})
endfunction()
