#include "rviz/rooms.h"

#include <algorithm>
#include <optional>

#include "devices/storeys.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

constexpr std::size_t kBuildingLinks = 10;
constexpr double kUsualHeight = 2.8;   // m, of a room without a ceiling link
constexpr double kSmallestRoom = 1.0;  // m^2
constexpr double kHalfWall = 0.05;     // m: floors end in the middle of walls
constexpr double kWallMargin = 0.2;    // m: an outermost wall ends that far inside at most

using Extent = Eigen::AlignedBox3d;

/// Around a link's boxes, in the model's frame.
Extent box_around(const desc::Link& link) {
  Extent box;
  for (const desc::Visual& visual : link.visuals) {
    if (visual.shape.type != Shape::Type::kBox) continue;
    const Pose pose = link.pose * visual.pose;
    const Vec3 half = pose.rotation.toRotationMatrix().cwiseAbs() * visual.shape.size / 2;
    box.extend(Extent(pose.position - half, pose.position + half));
  }
  return box;
}

std::string name_without(const std::string& name, const std::string& part) {
  const std::size_t at = name.find(part);
  if (at == std::string::npos) return "";
  std::string rest = name.substr(0, at) + name.substr(at + part.size());
  const auto is_bar = [](char c) { return c == '_'; };
  rest.erase(rest.begin(), std::find_if_not(rest.begin(), rest.end(), is_bar));
  rest.erase(std::find_if_not(rest.rbegin(), rest.rend(), is_bar).base(), rest.end());
  return rest;
}

double ceiling_over(const desc::Model& building, const std::string& room, double floor) {
  for (const desc::Link& link : building.links) {
    const Extent box = box_around(link);
    if (name_without(link.name, "ceiling") != room || box.isEmpty()) continue;
    if (box.min().z() > floor) return box.min().z();
  }
  return floor + kUsualHeight;
}

std::optional<Room> room_over(const desc::Model& building, const desc::Link& link) {
  Room room;
  room.building = building.name;
  room.name = name_without(link.name, "floor");
  const Extent floor = box_around(link);
  if (room.name.empty() || floor.isEmpty()) return std::nullopt;
  const Vec3 size = floor.sizes();
  if (size.x() * size.y() < kSmallestRoom) return std::nullopt;
  const double top = floor.max().z();
  room.size = Vec3(size.x() - 2 * kHalfWall, size.y() - 2 * kHalfWall,
                   ceiling_over(building, room.name, top) - top);
  const Pose middle{Vec3(floor.center().x(), floor.center().y(), top), Quat::Identity()};
  room.pose = building.pose * middle;
  return room;
}

}  // namespace

bool is_building(const desc::Model& model) {
  return model.is_static && model.links.size() > kBuildingLinks;
}

std::string storey_suffix(const sim::Structure& structure, std::uint32_t model, double z) {
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.model == model && !ros_kind(device).model.is_on_floor) return "";
  }
  return " " + std::to_string(devices::floor_of(z));
}

std::string outer_side(const desc::Model& building, const desc::Link& link) {
  Extent all;
  for (const desc::Link& other : building.links) all.extend(box_around(other));
  const Extent box = box_around(link);
  if (box.isEmpty()) return "";
  if (box.max().y() < all.min().y() + kWallMargin) return "south";
  if (box.min().y() > all.max().y() - kWallMargin) return "north";
  if (box.max().x() < all.min().x() + kWallMargin) return "west";
  if (box.min().x() > all.max().x() - kWallMargin) return "east";
  return "";
}

std::vector<Room> find_rooms(const sim::Structure& structure) {
  std::vector<Room> rooms;
  for (std::uint32_t i = 0; i < structure.models.size(); ++i) {
    const desc::Model& model = *structure.models[i];
    if (!is_building(model)) continue;
    for (const desc::Link& link : model.links) {
      std::optional<Room> room = room_over(model, link);
      if (!room) continue;
      room->storey = storey_suffix(structure, i, model.pose.position.z());
      rooms.push_back(std::move(*room));
    }
  }
  return rooms;
}

const Room* room_around(const std::vector<Room>& rooms, const Vec3& point) {
  for (const Room& room : rooms) {
    const Vec3 local = room.pose.inverse() * point;
    const Vec3 half = room.size / 2;
    if (std::abs(local.x()) <= half.x() && std::abs(local.y()) <= half.y() && local.z() >= 0.0 &&
        local.z() <= room.size.z()) {
      return &room;
    }
  }
  return nullptr;
}

}  // namespace angen::node
