#pragma once

#include <gazebo_msgs/LinkState.h>
#include <gazebo_msgs/ModelState.h>

#include "gazebo/server.h"
#include "ros/inbox.h"

namespace angen::node::gazebo {

/// Throws for a name that does not exist.
sim::Edit edit_of(const sim::Structure& structure, const gazebo_msgs::ModelState& state);

/// get_model_state, get_model_properties, get_world_properties, set_model_state,
/// set_model_configuration, delete_model.
void serve_models(Server& server);

/// Throws for a name that does not exist.
sim::Edit edit_of(const sim::Structure& structure, const gazebo_msgs::LinkState& state);

/// get_link_state, get_link_properties, set_link_state, set_link_properties, apply_body_wrench,
/// clear_body_wrenches.
void serve_links(Server& server);

/// get_joint_properties, set_joint_properties, apply_joint_effort, clear_joint_forces.
void serve_joints(Server& server);

}  // namespace angen::node::gazebo
