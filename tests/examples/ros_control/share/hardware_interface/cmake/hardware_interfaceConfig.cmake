set(hardware_interface_FOUND TRUE)
set(hardware_interface_INCLUDE_DIRS ${CMAKE_CURRENT_LIST_DIR}/../../../include)
