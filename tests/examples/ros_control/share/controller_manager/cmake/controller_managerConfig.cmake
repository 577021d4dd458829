set(controller_manager_FOUND TRUE)
set(controller_manager_FOUND_CATKIN_PROJECT TRUE)
set(controller_manager_INCLUDE_DIRS ${CMAKE_CURRENT_LIST_DIR}/../../../include)
