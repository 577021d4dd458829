#include <nav_msgs/Odometry.h>

#include <utility>

#include "ros/convert.h"
#include "ros/robots.h"
#include "ros/ros_kind.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

geometry_msgs::Quaternion quaternion_in(const Reading& reading) {
  const auto q = reading.get<std::vector<double>>("orientation");
  geometry_msgs::Quaternion out;
  out.x = q[0];
  out.y = q[1];
  out.z = q[2];
  out.w = q[3];
  return out;
}

template <class Vector>
Vector vector_in(const Reading& reading, const char* field) {
  const auto v = reading.get<std::vector<double>>(field);
  Vector out;
  out.x = v[0];
  out.y = v[1];
  out.z = v[2];
  return out;
}

/// The label's frame is the odometry's, its name the frame that it moves.
void fill(const Reading& reading, const Label& label, nav_msgs::Odometry& message) {
  message.child_frame_id = label.name;
  message.pose.pose.position = vector_in<geometry_msgs::Point>(reading, "position");
  message.pose.pose.orientation = quaternion_in(reading);
  message.twist.twist.linear.x = reading.get<double>("forward");
  message.twist.twist.linear.y = reading.get<double>("left");
  message.twist.twist.angular.z = reading.get<double>("turn");
  // Variances of Gazebo's drives: large for what a drive does not know.
  constexpr std::pair<std::size_t, double> kVariances[] = {{0, 1e-5},  {7, 1e-5},  {14, 1e12},
                                                           {21, 1e12}, {28, 1e12}, {35, 1e-3}};
  for (const auto& [at, variance] : kVariances) {
    message.pose.covariance[at] = message.twist.covariance[at] = variance;
  }
  add_planar(reading.get<std::vector<double>>("covariance"), message.pose.covariance);
}

void fill_transform(const Reading& reading, const Label& label,
                    geometry_msgs::TransformStamped& made) {
  made.child_frame_id = label.name;
  made.transform.translation = vector_in<geometry_msgs::Vector3>(reading, "position");
  made.transform.rotation = quaternion_in(reading);
}

/// The truth of a link: velocities are along the axes of the frame, and the label's name is that
/// of the link.
void fill_truth(const Reading& reading, const Label& label, nav_msgs::Odometry& message) {
  message.child_frame_id = label.name;
  message.pose.pose.position = vector_in<geometry_msgs::Point>(reading, "position");
  message.pose.pose.orientation = quaternion_in(reading);
  message.twist.twist.linear = vector_in<geometry_msgs::Vector3>(reading, "velocity");
  message.twist.twist.angular = vector_in<geometry_msgs::Vector3>(reading, "angular_velocity");
}

std::string frame_of(const sim::SensorEntry& sensor) {
  return value_of({&sensor.desc->plugin_element}, "odometryFrame", "odom");
}

RosKind::Odometry odometry_of(const sim::SensorEntry& sensor) {
  const std::vector<const Element*> plugin = {&sensor.desc->plugin_element};
  return {value_of(plugin, "robotBaseFrame", "base_footprint"),
          value_of(plugin, "odometrySource", "world") == "encoder"};
}

std::string link_of_truth(const sim::SensorEntry& sensor) {
  return sensor.desc->plugin_element.child_text("bodyName");
}

std::string frame_of_truth(const sim::SensorEntry& sensor) {
  return sensor.frame.empty() ? kWorldFrame : sensor.frame;
}

ANGEN_REGISTER_ROS_KIND({"odometry"},
                        RosKindBuilder()
                            .named_message<nav_msgs::Odometry>(&fill, "odom", "odometryTopic")
                            .transform(&fill_transform, "publishOdomTF")
                            .odometry(&frame_of, &odometry_of));
ANGEN_REGISTER_ROS_KIND({"planar_odometry"},
                        RosKindBuilder()
                            .named_message<nav_msgs::Odometry>(&fill, "odom", "odometryTopic")
                            .transform(&fill_transform, "publishOdometryTf")
                            .odometry(&frame_of, &odometry_of));
ANGEN_REGISTER_ROS_KIND({"kobuki_odometry"},
                        RosKindBuilder()
                            .named_message<nav_msgs::Odometry>(&fill, "odom", "none")
                            .transform(&fill_transform, "publish_tf")
                            .odometry(&frame_of, &odometry_of));
ANGEN_REGISTER_ROS_KIND({"skid_steer_odometry"},
                        RosKindBuilder()
                            .named_message<nav_msgs::Odometry>(&fill, "odom", "odometryTopic")
                            .transform(&fill_transform, "broadcastTF")
                            .odometry(&frame_of, &odometry_of));
ANGEN_REGISTER_ROS_KIND({"p3d"}, RosKindBuilder()
                                     .named_message<nav_msgs::Odometry>(&fill_truth, "p3d")
                                     .frame(&frame_of_truth)
                                     .truth(&link_of_truth));

}  // namespace
}  // namespace angen::node
