#pragma once

#include <atomic>

#include "gazebo/lights.h"
#include "gazebo/physics.h"
#include "gazebo/reconfigure.h"
#include "gazebo/server.h"
#include "gazebo/spawn.h"

namespace angen::node::gazebo {

/// The services of gazebo_ros, but for those that std_srvs/Empty has (node/services.h).
class Api {
 public:
  /// `node` has the queue of the threads that serve. `rate` is that of the node.
  Api(ros::NodeHandle& node, Inbox& inbox, const load::SearchPaths& paths, Topics topics,
      std::atomic<double>& rate);

 private:
  Server server_;
  Lights lights_;
  Spawner spawner_;
  PhysicsProperties physics_;
  Reconfigure reconfigure_;
};

}  // namespace angen::node::gazebo
