#include <geometry_msgs/Vector3Stamped.h>
#include <sensor_msgs/NavSatFix.h>

#include "ros/convert.h"
#include "ros/kinds/frames.h"
#include "ros/kinds/states.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::NavSatFix& message) {
  message.status.status = static_cast<std::int8_t>(reading.get<std::int64_t>("status"));
  message.status.service = static_cast<std::uint16_t>(reading.get<std::int64_t>("service"));
  message.latitude = reading.get<double>("latitude");
  message.longitude = reading.get<double>("longitude");
  message.altitude = reading.get<double>("altitude");
  auto variances = reading.get<std::vector<double>>("variances");
  variances.resize(3, 0.0);
  for (std::size_t i = 0; i < 3; ++i) message.position_covariance[4 * i] = variances[i];
  message.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
}

void fill_velocity(const Reading& reading, const Label&, geometry_msgs::Vector3Stamped& message) {
  message.vector = to_vector(vector_in(reading, "velocity"));
}

ANGEN_REGISTER_ROS_KIND({"gps"}, RosKindBuilder()
                                     .named_message<sensor_msgs::NavSatFix>(&fill, "fix")
                                     .named_message<geometry_msgs::Vector3Stamped>(
                                         &fill_velocity, "fix_velocity", "velocityTopicName")
                                     .frame(frame_by({"frameId", "bodyName"})));

}  // namespace
}  // namespace angen::node
