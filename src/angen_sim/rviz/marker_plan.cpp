#include "rviz/marker_plan.h"

#include <algorithm>

#include "ros/ros_kind.h"
#include "rviz/rooms.h"

namespace angen::node {
namespace {

constexpr float kWallAlpha = 0.3F;  // rooms are seen through walls

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

bool is_ground(const desc::Link& link) {
  return std::any_of(link.visuals.begin(), link.visuals.end(), [](const desc::Visual& visual) {
    return visual.shape.type == Shape::Type::kPlane;
  });
}

std::string with_side(const std::string& side) { return side.empty() ? "" : " " + side; }

float strongest_alpha(const std::string& group) {
  return group.rfind("walls", 0) == 0 ? kWallAlpha : 1.0F;
}

}  // namespace

std::string marker_group(const sim::Structure& structure, std::uint32_t link) {
  const sim::LinkEntry& entry = structure.links[link];
  const desc::Model& model = *structure.models[entry.model];
  const desc::Link& described = model.links[entry.link];
  if (is_ground(described)) return "ground";
  const double height = model.pose.position.z();
  const std::string storey = storey_suffix(structure, entry.model, height);
  for (const sim::DeviceEntry& device : structure.devices) {
    if (device.model != entry.model) continue;
    const ModelStyle& style = ros_kind(device).model;
    if (style.is_carried) continue;
    const std::string side = style.is_in_wall ? outer_side(structure, model) : "";
    return (style.group.empty() ? device.kind + "s" : style.group) + with_side(side) + storey;
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

DrawnModel draw_model(const sim::Structure& structure, std::uint32_t first_link,
                      std::int32_t& next_id) {
  DrawnModel drawn;
  const desc::Model& model = *structure.models[structure.links[first_link].model];
  for (std::uint32_t l = 0; l < model.links.size(); ++l) {
    const std::string group = marker_group(structure, first_link + l);
    const float alpha = strongest_alpha(group);
    DrawnLink link;
    for (const desc::Visual& visual : model.links[l].visuals) {
      for (Drawing& drawing : draw(visual)) {
        drawing.marker.header.frame_id = "world";
        drawing.marker.ns = group;
        drawing.marker.id = next_id++;
        drawing.marker.color.a = std::min(drawing.marker.color.a, alpha);
        const int limb = Anatomy::find(model.links[l].anatomy.limbs, visual.name);
        link.drawings.push_back({std::move(drawing), limb});
      }
    }
    drawn.links.push_back(std::move(link));
  }
  return drawn;
}

}  // namespace angen::node
