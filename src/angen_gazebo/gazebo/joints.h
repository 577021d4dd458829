#pragma once

#include "gazebo/server.h"
#include "ros/inbox.h"

namespace angen::node::gazebo {

/// get_joint_properties, set_joint_properties, apply_joint_effort, clear_joint_forces.
void serve_joints(Server& server, Inbox& inbox);

}  // namespace angen::node::gazebo
