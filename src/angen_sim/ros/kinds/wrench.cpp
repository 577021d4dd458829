#include <geometry_msgs/WrenchStamped.h>

#include "ros/convert.h"
#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// In the frame that the reading is in.
void fill(const Reading& reading, const Label&, geometry_msgs::WrenchStamped& message) {
  message.header.frame_id = reading.get<std::string>("frame");
  message.wrench.force = to_vector(vector_in(reading, "force"));
  message.wrench.torque = to_vector(vector_in(reading, "torque"));
}

ANGEN_REGISTER_ROS_KIND({"ft_sensor"},
                        RosKindBuilder().named_message<geometry_msgs::WrenchStamped>(&fill,
                                                                                     "ft_sensor"));
ANGEN_REGISTER_ROS_KIND({"f3d"},
                        RosKindBuilder().named_message<geometry_msgs::WrenchStamped>(&fill, "f3d"));

}  // namespace
}  // namespace angen::node
