#include <angen_msgs/ContactsArray.h>
#include <gazebo_msgs/ContactsState.h>

#include <algorithm>

#include "ros/convert.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// In the frame that the reading is in, whatever the label says; torques are about its origin.
void fill(const Reading& reading, const Label&, gazebo_msgs::ContactsState& message) {
  const auto frame = reading.get<std::string>("frame");
  message.header.frame_id = frame.empty() ? "world" : frame;
  const auto first = reading.get<std::vector<std::string>>("collision1");
  const auto second = reading.get<std::vector<std::string>>("collision2");
  const auto counts = reading.get<std::vector<double>>("counts");
  const auto positions = reading.get<std::vector<double>>("positions");
  const auto normals = reading.get<std::vector<double>>("normals");
  const auto depths = reading.get<std::vector<double>>("depths");
  const auto forces = reading.get<std::vector<double>>("forces");
  const std::size_t points =
      std::min({positions.size() / 3, normals.size() / 3, depths.size(), forces.size() / 3});
  std::size_t next = 0;
  for (std::size_t i = 0; i < std::min({first.size(), second.size(), counts.size()}); ++i) {
    gazebo_msgs::ContactState state;
    state.collision1_name = first[i];
    state.collision2_name = second[i];
    state.info = first[i] + " touches " + second[i];
    Vec3 force_sum = Vec3::Zero();
    Vec3 torque_sum = Vec3::Zero();
    for (auto left = static_cast<std::size_t>(counts[i]); left > 0 && next < points;
         --left, ++next) {
      const Vec3 position = Vec3::Map(&positions[3 * next]);
      const Vec3 force = Vec3::Map(&forces[3 * next]);
      const Vec3 torque = position.cross(force);
      geometry_msgs::Wrench wrench;
      wrench.force = to_vector(force);
      wrench.torque = to_vector(torque);
      state.wrenches.push_back(wrench);
      state.contact_positions.push_back(to_vector(position));
      state.contact_normals.push_back(to_vector(Vec3::Map(&normals[3 * next])));
      state.depths.push_back(depths[next]);
      force_sum += force;
      torque_sum += torque;
    }
    state.total_wrench.force = to_vector(force_sum);
    state.total_wrench.torque = to_vector(torque_sum);
    message.states.push_back(std::move(state));
  }
}

ANGEN_REGISTER_ROS_KIND(
    {"contact"},
    RosKindBuilder().message_with_array<gazebo_msgs::ContactsState, angen_msgs::ContactsArray>(
        &fill));

}  // namespace
}  // namespace angen::node
