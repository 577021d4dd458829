set(hardware_interface_FOUND TRUE)
set(hardware_interface_INCLUDE_DIRS ${CMAKE_CURRENT_LIST_DIR}/../../../include)
set(hardware_interface_FOUND_CATKIN_PROJECT TRUE)
