#include "rviz/marker_plan.h"

#include <algorithm>

#include "scene/groups.h"

namespace angen::node {
namespace {

constexpr float kWallAlpha = 0.3F;  // rooms are seen through walls

float strongest_alpha(const std::string& group) {
  return group.rfind("walls", 0) == 0 ? kWallAlpha : 1.0F;
}

}  // namespace

DrawnModel draw_model(const sim::Structure& structure, std::uint32_t first_link,
                      std::int32_t& next_id) {
  DrawnModel drawn;
  const desc::Model& model = *structure.models[structure.links[first_link].model];
  for (std::uint32_t l = 0; l < model.links.size(); ++l) {
    const std::string group = scene::group_of(structure, first_link + l);
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
