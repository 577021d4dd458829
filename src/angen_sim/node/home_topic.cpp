#include "node/home_topic.h"

#include "ros/convert.h"

namespace angen::node {
namespace {

geometry_msgs::Pose to_ros(const FloorPose& pose) {
  return node::to_ros(Pose{pose.position, from_rpy(0.0, 0.0, pose.yaw)});
}

geometry_msgs::Polygon to_ros(const Polygon& polygon, double z) {
  geometry_msgs::Polygon out;
  for (const Point2& corner : polygon) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(corner.x());
    point.y = static_cast<float>(corner.y());
    point.z = static_cast<float>(z);
    out.points.push_back(point);
  }
  return out;
}

angen_msgs::HomeStorey to_part(const Storey& storey) {
  angen_msgs::HomeStorey out;
  out.number = storey.number;
  out.name = storey.name;
  out.elevation = storey.elevation;
  out.height = storey.height;
  return out;
}

angen_msgs::HomeRoom to_part(const Room& room) {
  angen_msgs::HomeRoom out;
  out.name = room.name;
  out.use = room.use;
  out.storey = room.storey;
  out.polygon = to_ros(room.outline, room.floor);
  for (const Polygon& hole : room.holes) out.holes.push_back(to_ros(hole, room.floor));
  out.floor = room.floor;
  out.ceiling = room.ceiling;
  out.area = room.area;
  out.guessed = room.guessed;
  return out;
}

angen_msgs::HomePlace to_part(const Place& place) {
  angen_msgs::HomePlace out;
  out.posture = place.posture;
  out.pose = to_ros(place.pose);
  return out;
}

angen_msgs::HomeLanding to_part(const Landing& landing) {
  angen_msgs::HomeLanding out;
  out.storey = landing.storey;
  out.room = landing.room;
  out.pose = to_ros(landing.pose);
  return out;
}

angen_msgs::HomeThing to_part(const Thing& thing) {
  angen_msgs::HomeThing out;
  out.name = thing.name;
  out.type = thing.type;
  out.room = thing.room;
  out.pose = node::to_ros(thing.pose);
  for (const Place& place : thing.places) out.places.push_back(to_part(place));
  return out;
}

angen_msgs::HomeDoor to_part(const HomeDoor& door) {
  angen_msgs::HomeDoor out;
  out.name = door.name;
  out.kind = name_of(door.kind);
  out.rooms[0] = door.rooms[0];
  out.rooms[1] = door.rooms[1];
  out.width = door.width;
  out.height = door.height;
  out.pose = to_ros(door.pose);
  out.partner = door.partner;
  return out;
}

angen_msgs::HomeElevator to_part(const HomeElevator& elevator) {
  angen_msgs::HomeElevator out;
  out.name = elevator.name;
  out.pose = node::to_ros(elevator.pose);
  for (const Landing& landing : elevator.landings) out.landings.push_back(to_part(landing));
  return out;
}

template <class Part, class Message>
void add_parts(const std::vector<Part>& parts, std::vector<Message>& to) {
  for (const Part& part : parts) to.push_back(to_part(part));
}

}  // namespace

angen_msgs::Home to_message(const Home& home) {
  angen_msgs::Home out;
  out.entrance = home.entrance;
  out.north = home.north;
  out.latitude = home.latitude;
  out.start = home.start;
  add_parts(home.storeys, out.storeys);
  add_parts(home.rooms, out.rooms);
  add_parts(home.things, out.things);
  add_parts(home.doors, out.doors);
  add_parts(home.elevators, out.elevators);
  return out;
}

HomeTopic::HomeTopic(ros::NodeHandle& node) : publisher_(node, "/angen/home", 1) {}

void HomeTopic::on_structure(const sim::Structure& structure) {
  if (structure.home == home_) return;
  home_ = structure.home;
  publisher_.set([home = home_] { return to_message(home->get()); });
}

}  // namespace angen::node
