#include "gazebo/api.h"

#include "gazebo/joints.h"
#include "gazebo/links.h"
#include "gazebo/models.h"

namespace angen::node::gazebo {

Api::Api(ros::NodeHandle& node, Inbox& inbox, const load::SearchPaths& paths, Topics topics,
         std::atomic<double>& rate)
    : server_(node),
      lights_(server_, inbox),
      spawner_(server_, inbox, paths, topics, lights_),
      physics_(server_, inbox, rate),
      reconfigure_(node, physics_) {
  serve_models(server_, inbox);
  serve_links(server_, inbox);
  serve_joints(server_, inbox);
}

}  // namespace angen::node::gazebo
