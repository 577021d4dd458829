#pragma once

#include <ros/duration.h>
#include <ros/time.h>

#include "sim/edit.h"

namespace angen::node::gazebo {

/// A negative duration has no end.
inline sim::PushTime push_time(const ros::Time& start, const ros::Duration& duration) {
  return {static_cast<Nanoseconds>(start.toNSec()),
          duration < ros::Duration(0) ? -1 : static_cast<Nanoseconds>(duration.toNSec())};
}

}  // namespace angen::node::gazebo
