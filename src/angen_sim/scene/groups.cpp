#include "scene/groups.h"

#include <algorithm>

namespace angen::scene {
namespace {

constexpr std::size_t kBuildingLinks = 10;
constexpr double kWallMargin = 0.2;  // m: an outermost wall ends that far inside at most

using Extent = Eigen::AlignedBox3d;

/// Around a link's boxes, in the frame in which its model is at `model`.
Extent box_around(const desc::Link& link, const Pose& model = Pose()) {
  Extent box;
  for (const desc::Visual& visual : link.visuals) {
    if (visual.shape.type != Shape::Type::kBox) continue;
    const Pose pose = model * link.pose * visual.pose;
    const Vec3 half = pose.rotation.toRotationMatrix().cwiseAbs() * visual.shape.size / 2;
    box.extend(Extent(pose.position - half, pose.position + half));
  }
  return box;
}

Extent box_around(const desc::Model& model, const Pose& at = Pose()) {
  Extent box;
  for (const desc::Link& link : model.links) box.extend(box_around(link, at));
  return box;
}

std::string side_of(const Extent& all, const Extent& box) {
  if (box.isEmpty()) return "";
  if (box.max().y() < all.min().y() + kWallMargin) return "south";
  if (box.min().y() > all.max().y() - kWallMargin) return "north";
  if (box.max().x() < all.min().x() + kWallMargin) return "west";
  if (box.min().x() > all.max().x() - kWallMargin) return "east";
  return "";
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

bool is_ground(const desc::Link& link) {
  return std::any_of(link.visuals.begin(), link.visuals.end(), [](const desc::Visual& visual) {
    return visual.shape.type == Shape::Type::kPlane;
  });
}

std::string with_side(const std::string& side) { return side.empty() ? "" : " " + side; }

}  // namespace

bool is_building(const desc::Model& model) {
  return model.is_static && (model.links.size() > kBuildingLinks || !model.home.rooms.empty());
}

std::string storey_suffix(const sim::Structure& structure, std::uint32_t model, double z) {
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.model == model && device.plugin->kind().changes_storeys()) return "";
  }
  return " " + std::to_string(floor_at(structure.storeys, z));
}

std::string group_of(const sim::Structure& structure, std::uint32_t link) {
  const sim::LinkEntry& entry = structure.links[link];
  const desc::Model& model = *structure.models[entry.model];
  const desc::Link& described = model.links[entry.link];
  if (is_ground(described)) return "ground";
  const double height = model.pose.position.z();
  const std::string storey = storey_suffix(structure, entry.model, height);
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.model != entry.model) continue;
    const Kind& kind = device.plugin->kind();
    if (kind.group().empty()) continue;
    const bool in_wall = kind.passage() == Kind::Passage::kWindow;
    const std::string side = in_wall ? outer_side(structure, model) : "";
    return kind.group() + with_side(side) + storey;
  }
  if (is_building(model)) {
    if (has(described.name, "ceiling")) return "ceilings" + storey;
    if (has(described.name, "floor")) return "floors" + storey;
    const std::string side = outer_side(model, described);
    return "walls" + with_side(side) + storey;
  }
  const bool senses = model.is_static && !described.sensors.empty();
  return (senses ? "sensors" : "furniture") + storey;
}

std::string outer_side(const desc::Model& building, const desc::Link& link) {
  return side_of(box_around(building), box_around(link));
}

std::string outer_side(const sim::Structure& structure, const desc::Model& window) {
  for (const std::shared_ptr<const desc::Model>& building : structure.models) {
    if (!is_building(*building)) continue;
    const Extent all = box_around(*building);
    const Vec3 middle = box_around(window, building->pose.inverse() * window.pose).center();
    if (!all.contains(middle)) continue;
    return side_of(all, Extent(middle, middle));
  }
  return "";
}

std::string outer_side(const sim::Structure& structure, const Extent& surface) {
  for (const std::shared_ptr<const desc::Model>& building : structure.models) {
    if (!is_building(*building)) continue;
    const Extent all = box_around(*building);
    const Pose to_building = building->pose.inverse();
    Extent local(to_building * surface.min());
    local.extend(to_building * surface.max());
    if (all.contains(local.center())) return side_of(all, local);
  }
  return "";
}

}  // namespace angen::scene
