#include <nav_msgs/Odometry.h>

#include <utility>

#include "ros/convert.h"
#include "ros/kinds/states.h"
#include "ros/robots.h"
#include "ros/ros_kind.h"
#include "ros/wire.h"

namespace angen::node {
namespace {

void fill_pose(const Reading& reading, geometry_msgs::Pose& pose) {
  pose.position = to_point(vector_in(reading, "position"));
  pose.orientation = to_ros(orientation_in(reading));
}

/// The label's frame is the odometry's, its name the frame that it moves.
void fill(const Reading& reading, const Label& label, nav_msgs::Odometry& message) {
  message.child_frame_id = label.name;
  fill_pose(reading, message.pose.pose);
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
  made.transform.translation = to_vector(vector_in(reading, "position"));
  made.transform.rotation = to_ros(orientation_in(reading));
}

/// The truth of a link: velocities are along the axes of the frame, and the label's name is that of
/// the link.
void fill_truth(const Reading& reading, const Label& label, nav_msgs::Odometry& message) {
  message.child_frame_id = label.name;
  fill_pose(reading, message.pose.pose);
  message.twist.twist.linear = to_vector(vector_in(reading, "velocity"));
  message.twist.twist.angular = to_vector(vector_in(reading, "angular_velocity"));
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

RosKindBuilder odometry(const char* topic_parameter, const char* off_switch) {
  return RosKindBuilder()
      .named_message<nav_msgs::Odometry>(&fill, "odom", topic_parameter)
      .transform(&fill_transform, off_switch)
      .odometry(&frame_of, &odometry_of);
}

ANGEN_REGISTER_ROS_KIND({"odometry"}, odometry("odometryTopic", "publishOdomTF"));
ANGEN_REGISTER_ROS_KIND({"planar_odometry"}, odometry("odometryTopic", "publishOdometryTf"));
ANGEN_REGISTER_ROS_KIND({"kobuki_odometry"}, odometry("none", "publish_tf"));
ANGEN_REGISTER_ROS_KIND({"skid_steer_odometry"}, odometry("odometryTopic", "broadcastTF"));
ANGEN_REGISTER_ROS_KIND({"p3d"}, RosKindBuilder()
                                     .named_message<nav_msgs::Odometry>(&fill_truth, "p3d")
                                     .frame(&frame_of_truth)
                                     .truth(&link_of_truth));

}  // namespace
}  // namespace angen::node
