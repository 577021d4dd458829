# For <gazebo/joint_control.h>: headers are in the sources, or with those of angen_sim in an installation.
if(angen_gazebo_SOURCE_PREFIX)
  list(APPEND angen_sim_INCLUDE_DIRS ${angen_gazebo_SOURCE_PREFIX})
endif()
