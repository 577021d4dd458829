#include <geometry_msgs/WrenchStamped.h>

#include "ros/convert.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// In the frame that the reading is in.
void fill(const Reading& reading, const Label&, geometry_msgs::WrenchStamped& message) {
  const auto vector = [&](const char* field) {
    auto v = reading.get<std::vector<double>>(field);
    v.resize(3, 0.0);
    return to_vector(Vec3(v[0], v[1], v[2]));
  };
  message.header.frame_id = reading.get<std::string>("frame");
  message.wrench.force = vector("force");
  message.wrench.torque = vector("torque");
}

ANGEN_REGISTER_ROS_KIND({"ft_sensor"},
                        RosKindBuilder().named_message<geometry_msgs::WrenchStamped>(&fill,
                                                                                     "ft_sensor"));
ANGEN_REGISTER_ROS_KIND({"f3d"},
                        RosKindBuilder().named_message<geometry_msgs::WrenchStamped>(&fill, "f3d"));

}  // namespace
}  // namespace angen::node
