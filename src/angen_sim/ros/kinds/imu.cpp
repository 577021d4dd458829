#include <sensor_msgs/Imu.h>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::Imu& message) {
  const auto q = reading.get<std::vector<double>>("orientation");
  message.orientation.x = q[0];
  message.orientation.y = q[1];
  message.orientation.z = q[2];
  message.orientation.w = q[3];
  const auto set = [&](const char* field, geometry_msgs::Vector3& to) {
    const auto v = reading.get<std::vector<double>>(field);
    to.x = v[0];
    to.y = v[1];
    to.z = v[2];
  };
  set("angular_velocity", message.angular_velocity);
  set("acceleration", message.linear_acceleration);
}

ANGEN_REGISTER_ROS_KIND({"imu"}, RosKindBuilder().named_message<sensor_msgs::Imu>(&fill, "imu"));
ANGEN_REGISTER_ROS_KIND({"imu_sensor"},
                        RosKindBuilder().named_message<sensor_msgs::Imu>(&fill, "imu_data"));
ANGEN_REGISTER_ROS_KIND({"kobuki_imu"}, RosKindBuilder().named_message<sensor_msgs::Imu>(
                                            &fill, "mobile_base/sensors/imu_data", "none"));
ANGEN_REGISTER_ROS_KIND({"hector_imu"},
                        RosKindBuilder().named_message<sensor_msgs::Imu>(&fill, "imu"));

}  // namespace
}  // namespace angen::node
