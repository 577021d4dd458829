#include "gazebo/api.h"

#include "gazebo/joints.h"
#include "gazebo/links.h"
#include "gazebo/models.h"

namespace angen::node::gazebo {

Api::Api(ros::NodeHandle& node, Inbox& inbox, const load::SearchPaths& paths, Topics topics,
         std::atomic<double>& rate)
    : server_(node),
      spawner_(server_, inbox, paths, topics),
      physics_(server_, inbox, rate),
      lights_(server_, inbox),
      reconfigure_(node, physics_) {
  serve_models(server_, inbox);
  serve_links(server_, inbox);
  serve_joints(server_, inbox);
}

}  // namespace angen::node::gazebo
