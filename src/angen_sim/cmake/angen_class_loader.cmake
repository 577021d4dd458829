# Target angen_class_loader. Debian's class_loader comes with a CMake file that needs ROS 2's ament; library and
# headers are all we need of it.
#catkin_lint: ignore unconfigured_build_depend
if(NOT TARGET angen_class_loader)
  add_library(angen_class_loader INTERFACE)
  find_path(CLASS_LOADER_HEADERS class_loader/class_loader.hpp PATH_SUFFIXES class_loader REQUIRED)
  find_path(RCPPUTILS_HEADERS rcpputils/shared_library.hpp PATH_SUFFIXES rcpputils REQUIRED)
  find_path(RCUTILS_HEADERS rcutils/shared_library.h PATH_SUFFIXES rcutils REQUIRED)
  find_library(CLASS_LOADER_LIBRARY class_loader REQUIRED)
  find_library(CONSOLE_BRIDGE_LIBRARY console_bridge REQUIRED)
  #catkin_lint: ignore_once external_interface_path
  target_include_directories(angen_class_loader SYSTEM INTERFACE
    ${CLASS_LOADER_HEADERS} ${RCPPUTILS_HEADERS} ${RCUTILS_HEADERS})
  target_link_libraries(angen_class_loader INTERFACE ${CLASS_LOADER_LIBRARY} ${CONSOLE_BRIDGE_LIBRARY})
endif()
