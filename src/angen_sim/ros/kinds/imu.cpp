#include <sensor_msgs/Imu.h>

#include "ros/convert.h"
#include "ros/kinds/frames.h"
#include "ros/kinds/states.h"

namespace angen::node {
namespace {

void fill(const Reading& reading, const Label&, sensor_msgs::Imu& message) {
  message.orientation = to_ros(orientation_in(reading));
  message.angular_velocity = to_vector(vector_in(reading, "angular_velocity"));
  message.linear_acceleration = to_vector(vector_in(reading, "acceleration"));
  auto variances = reading.get<std::vector<double>>("variances");
  variances.resize(9, 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    message.orientation_covariance[4 * i] = variances[i];
    message.angular_velocity_covariance[4 * i] = variances[3 + i];
    message.linear_acceleration_covariance[4 * i] = variances[6 + i];
  }
}

std::string frame_of_body(const sim::SensorEntry& sensor) {
  return sensor.frame.empty() ? frame_by({"bodyName"})(sensor) : sensor.frame;
}

std::string gyro_frame(const sim::SensorEntry&) { return "gyro_link"; }

ANGEN_REGISTER_ROS_KIND(
    {"imu"}, RosKindBuilder().named_message<sensor_msgs::Imu>(&fill, "imu").frame(&frame_of_body));
ANGEN_REGISTER_ROS_KIND(
    {"imu_sensor"},
    RosKindBuilder().named_message<sensor_msgs::Imu>(&fill, "imu_data").frame(&frame_of_body));
ANGEN_REGISTER_ROS_KIND({"kobuki_imu"},
                        RosKindBuilder()
                            .named_message<sensor_msgs::Imu>(&fill, "mobile_base/sensors/imu_data",
                                                             "none")
                            .frame(&gyro_frame));
ANGEN_REGISTER_ROS_KIND({"hector_imu"}, RosKindBuilder()
                                            .named_message<sensor_msgs::Imu>(&fill, "imu")
                                            .frame(frame_by({"frameId", "bodyName"})));

}  // namespace
}  // namespace angen::node
