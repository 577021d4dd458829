#include "rviz/markers.h"

#include <algorithm>
#include <chrono>

#include "ros/convert.h"
#include "scene/groups.h"

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kMarkerPeriod(66);
constexpr float kWallAlpha = 0.3F;  // rooms are seen through walls

float strongest_alpha(const std::string& group) {
  return group.rfind("walls", 0) == 0 ? kWallAlpha : 1.0F;
}

/// A model's markers, numbered from `next_id` on. `first_link` is the index of the model's first
/// link in Structure::links.
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

}  // namespace

Markers::Markers(ros::NodeHandle& node, Readings& readings)
    : publisher_(LazyPublisher::of<visualization_msgs::MarkerArray>(node, "angen/markers", 100)),
      overlays_(next_id_, readings) {}

void Markers::draw_models(const sim::Structure& structure, const Changes& changes) {
  std::vector<DrawnModel> old = std::exchange(models_, {});
  models_.resize(structure.models.size());
  links_.clear();
  for (std::uint32_t m = 0; m < models_.size(); ++m) {
    const std::uint32_t before = changes.models.before[m];
    const auto first = static_cast<std::uint32_t>(links_.size());
    models_[m] =
        before != Numbers::kNone ? std::move(old[before]) : draw_model(structure, first, next_id_);
    for (DrawnLink& link : models_[m].links) {
      links_.push_back(&link);
      if (before == Numbers::kNone) mark(static_cast<std::uint32_t>(links_.size() - 1));
    }
  }
  bodies_.clear();
  for (std::uint32_t d = 0; d < structure.devices.size(); ++d) {
    const sim::DeviceEntry& device = structure.devices[d];
    if (device.body < 0) continue;
    const auto link = static_cast<std::uint32_t>(device.body);
    bodies_.emplace_back(d, structure.first_link(device.model) + link);
  }
  for (const DrawnModel& removed : old) {  // models that stay have been moved out
    for (const DrawnLink& link : removed.links) {
      for (const Drawing& drawing : link.drawings) gone_.markers.push_back(drawing.marker);
    }
  }
}

void Markers::on_structure(const sim::Snapshot& snapshot) {
  const sim::Structure& structure = *snapshot.structure;
  const Changes changes = changes_between(structure_.get(), structure);
  const std::vector<std::uint32_t> pending = std::exchange(changed_, {});
  marked_.assign(structure.links.size(), false);
  for (const std::uint32_t link : pending) {
    if (changes.links.after[link] != Numbers::kNone) mark(changes.links.after[link]);
  }
  draw_models(structure, changes);
  overlays_.on_structure(structure, changes, gone_);
  structure_ = snapshot.structure;
}

void Markers::mark(std::uint32_t link) {
  if (marked_[link]) return;
  marked_[link] = true;
  changed_.push_back(link);
}

void Markers::mark_limbs(const sim::Snapshot& snapshot) {
  for (const auto& [device, link] : bodies_) {
    if (links_[link]->limbs == snapshot.limbs[device]) continue;
    links_[link]->limbs = snapshot.limbs[device];
    mark(link);
  }
}

void Markers::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (!publisher_.has_subscribers()) return;
  if (snapshot.structure != structure_) on_structure(snapshot);
  for (const std::uint32_t link : snapshot.moved_links) mark(link);
  mark_limbs(snapshot);
  if (now < next_send_) return;
  next_send_ = now + kMarkerPeriod;
  const std::uint64_t joined = publisher_.subscriptions();
  const Array array = collect(snapshot, joined != joined_);
  joined_ = joined;
  if (array.markers.empty()) return;
  publisher_.publish([&]() -> const Array& { return array; });
}

Markers::Array Markers::collect(const sim::Snapshot& snapshot, bool all) {
  Array array;
  for (visualization_msgs::Marker& marker : gone_.markers) {
    marker.action = visualization_msgs::Marker::DELETE;
    array.markers.push_back(std::move(marker));
  }
  gone_.markers.clear();
  if (all) {
    for (std::uint32_t i = 0; i < links_.size(); ++i) put_link(snapshot, i, array);
  } else {
    for (const std::uint32_t link : changed_) put_link(snapshot, link, array);
  }
  for (const std::uint32_t link : std::exchange(changed_, {})) marked_[link] = false;
  overlays_.append(snapshot, all, array);
  return array;
}

void Markers::put_link(const sim::Snapshot& snapshot, std::uint32_t link, Array& array) {
  const DrawnLink& drawn = *links_[link];
  const Pose& at = snapshot.link_poses[link];
  for (const LinkDrawing& drawing : drawn.drawings) {
    const bool swings = drawn.limbs && drawing.limb >= 0;
    const Pose body = swings ? at * drawn.limbs->at(static_cast<std::size_t>(drawing.limb)) : at;
    array.markers.push_back(drawing.marker);
    array.markers.back().pose = to_ros(body * drawing.offset);
  }
}

}  // namespace angen::node
