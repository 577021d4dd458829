#pragma once

#include <geometry_msgs/Twist.h>

#include "ros/command_topic.h"

namespace angen::node {

/// Speeds forward and about z, as wheels on an axle have them.
inline Command of_twist(const geometry_msgs::Twist& twist) {
  return command_of({twist.linear.x, twist.angular.z});
}

}  // namespace angen::node
