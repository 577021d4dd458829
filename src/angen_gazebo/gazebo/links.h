#pragma once

#include <gazebo_msgs/LinkState.h>

#include "gazebo/server.h"
#include "ros/inbox.h"

namespace angen::node::gazebo {

/// Throws for a name that does not exist.
sim::Edit edit_of(const sim::Structure& structure, const gazebo_msgs::LinkState& state);

/// get_link_state, get_link_properties, set_link_state, set_link_properties, apply_body_wrench,
/// clear_body_wrenches.
void serve_links(Server& server, Inbox& inbox);

}  // namespace angen::node::gazebo
