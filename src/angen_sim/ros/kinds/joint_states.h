#pragma once

#include "ros/ros_kind.h"

namespace angen::node {

/// sensor_msgs/JointState on joint_states, below the robot's namespace.
RosKindBuilder joint_states();

}  // namespace angen::node
