#include "ros/marker_plan.h"

#include <algorithm>

#include "devices/storeys.h"

namespace angen::node {
namespace {

constexpr std::size_t kBuildingLinks = 10;
// One sees the rooms through walls, and a storey through the floor of the next.
constexpr float kWallAlpha = 0.22F;
constexpr float kUpperFloorAlpha = 0.5F;

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

bool is_ground(const desc::Link& link) {
  return std::any_of(link.visuals.begin(), link.visuals.end(), [](const desc::Visual& visual) {
    return visual.shape.type == Shape::Type::kPlane;
  });
}

// What a model carries says nothing of what it is.
bool is_carried(const std::string& kind) {
  return kind == "tag" || kind == "battery" || kind == "climate";
}

std::string device_group(const std::string& kind) {
  if (kind == "person") return "people";
  return kind == "drive" ? "robots" : kind + "s";
}

float strongest_alpha(const std::string& group) {
  if (group.rfind("walls", 0) == 0) return kWallAlpha;
  return group.rfind("floors", 0) == 0 && group != "floors 0" ? kUpperFloorAlpha : 1.0F;
}

}  // namespace

std::string marker_group(const sim::Structure& structure, std::uint32_t link) {
  const sim::LinkEntry& entry = structure.links[link];
  const desc::Model& model = *structure.models[entry.model];
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.model == entry.model && !is_carried(device.kind)) return device_group(device.kind);
  }
  const desc::Link& described = model.links[entry.link];
  if (is_ground(described)) return "ground";
  if (model.is_static && model.links.size() > kBuildingLinks) {
    const std::string floor = " " + std::to_string(devices::floor_of(model.pose.position.z()));
    if (has(described.name, "ceiling")) return "ceilings" + floor;
    if (has(described.name, "floor")) return "floors" + floor;
    return "walls" + floor;
  }
  return model.is_static && !described.sensors.empty() ? "sensors" : "furniture";
}

DrawnModel draw_model(const sim::Structure& structure, std::uint32_t first_link,
                      std::int32_t& next_id) {
  DrawnModel drawn;
  drawn.model = structure.models[structure.links[first_link].model];
  for (std::uint32_t l = 0; l < drawn.model->links.size(); ++l) {
    const std::string group = marker_group(structure, first_link + l);
    const float alpha = strongest_alpha(group);
    std::vector<Drawing> drawings;
    for (const desc::Visual& visual : drawn.model->links[l].visuals) {
      for (Drawing& drawing : draw(visual)) {
        drawing.marker.header.frame_id = "world";
        drawing.marker.ns = group;
        drawing.marker.id = next_id++;
        drawing.marker.color.a = std::min(drawing.marker.color.a, alpha);
        drawings.push_back(std::move(drawing));
      }
    }
    drawn.links.push_back(std::move(drawings));
  }
  return drawn;
}

}  // namespace angen::node
