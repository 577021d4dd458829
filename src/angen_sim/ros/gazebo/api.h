#pragma once

#include <atomic>

#include "ros/gazebo/lights.h"
#include "ros/gazebo/physics.h"
#include "ros/gazebo/reconfigure.h"
#include "ros/gazebo/server.h"
#include "ros/gazebo/spawn.h"

namespace angen::node::gazebo {

/// The services of gazebo_ros, but for those that std_srvs/Empty has (ros/services.h).
class Api {
 public:
  /// `node` has the queue of the threads that serve. `rate` is that of the node.
  Api(ros::NodeHandle& node, Inbox& inbox, const load::SearchPaths& paths, Topics topics,
      std::atomic<double>& rate);

 private:
  Server server_;
  Spawner spawner_;
  PhysicsProperties physics_;
  Lights lights_;
  Reconfigure reconfigure_;
};

}  // namespace angen::node::gazebo
