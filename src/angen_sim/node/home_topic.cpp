#include "node/home_topic.h"

#include "core/home_fields.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

template <class Value>
void fill(const Value& value, Value& field) {
  field = value;
}

void fill(bool value, std::uint8_t& field) { field = value ? 1 : 0; }

void fill(const Pose& pose, geometry_msgs::Pose& field) { field = to_ros(pose); }

void fill(const FloorPose& pose, geometry_msgs::Pose& field) {
  field = to_ros(Pose{pose.position, from_rpy(0.0, 0.0, pose.yaw)});
}

void fill(const std::string (&names)[2], boost::array<std::string, 2>& field) {
  field = {names[0], names[1]};
}

void fill(const Polygon& polygon, geometry_msgs::Polygon& field) {
  for (const Point2& corner : polygon) {
    geometry_msgs::Point32& point = field.points.emplace_back();
    point.x = static_cast<float>(corner.x());
    point.y = static_cast<float>(corner.y());
  }
}

template <class Part, class Message>
auto fill(const Part& part, Message& message) -> decltype(visit_fields(part, 0));

template <class Each, class Message>
void fill(const std::vector<Each>& all, std::vector<Message>& field) {
  for (const Each& each : all) fill(each, field.emplace_back());
}

template <class Part, class Message>
auto fill(const Part& part, Message& message) -> decltype(visit_fields(part, 0)) {
  visit_fields(part, [&](const char*, const auto& value, const auto& of_message) {
    fill(value, of_message(message));
  });
}

void raise(geometry_msgs::Polygon& polygon, double z) {
  for (geometry_msgs::Point32& point : polygon.points) point.z = static_cast<float>(z);
}

}  // namespace

angen_msgs::Home to_message(const Home& home) {
  angen_msgs::Home out;
  fill(home, out);
  for (angen_msgs::HomeRoom& room : out.rooms) {
    raise(room.polygon, room.floor);
    for (geometry_msgs::Polygon& hole : room.holes) raise(hole, room.floor);
  }
  return out;
}

HomeTopic::HomeTopic(ros::NodeHandle& node) : publisher_(node, "angen/home", 1) {}

void HomeTopic::on_structure(const sim::Structure& structure) {
  if (structure.home == home_) return;
  home_ = structure.home;
  publisher_.set([home = home_] { return to_message(home->get()); });
}

}  // namespace angen::node
