#include "ros/ros_kind.h"

namespace angen::node {
namespace {

ANGEN_REGISTER_ROS_KIND({"tag", "climate"}, RosKindBuilder().carried());

}  // namespace
}  // namespace angen::node
