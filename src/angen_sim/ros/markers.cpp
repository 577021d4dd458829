#include "ros/markers.h"

#include <chrono>
#include <set>
#include <utility>

#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr std::chrono::milliseconds kMarkerPeriod(66);

}  // namespace

Markers::Markers(ros::NodeHandle& node)
    : publisher_(LazyPublisher::of<visualization_msgs::MarkerArray>(node, "/angen/markers", 100)) {}

void Markers::on_structure(const sim::Snapshot& snapshot) {
  const sim::Structure& structure = *snapshot.structure;
  std::map<const desc::Model*, DrawnModel> old = std::exchange(models_, {});
  std::set<const std::vector<Drawing>*> pending;  // moved, and not published yet
  for (const std::uint32_t link : changed_) pending.insert(links_[link]);
  links_.assign(structure.links.size(), nullptr);
  marked_.assign(structure.links.size(), false);
  changed_.clear();
  for (std::uint32_t i = 0; i < structure.links.size(); ++i) {
    const sim::LinkEntry& entry = structure.links[i];
    const desc::Model* model = structure.models[entry.model].get();
    if (models_.count(model) == 0) {
      const auto before = old.find(model);
      const bool known = before != old.end();
      models_[model] =
          known ? std::move(before->second) : draw_model(structure, i - entry.link, next_id_);
      if (known) old.erase(before);
      for (std::uint32_t l = 0; !known && l < models_[model].links.size(); ++l) {
        mark(i - entry.link + l);
      }
    }
    links_[i] = &models_[model].links[entry.link];
    if (pending.count(links_[i]) > 0) mark(i);
  }
  for (const auto& [model, drawn] : old) {
    for (const auto& drawings : drawn.links) {
      for (const Drawing& drawing : drawings) gone_.markers.push_back(drawing.marker);
    }
  }
  overlays_.on_structure(snapshot, next_id_, gone_);
  structure_ = snapshot.structure;  // the models of the one before were known by their addresses
}

void Markers::mark(std::uint32_t link) {
  if (marked_[link]) return;
  marked_[link] = true;
  changed_.push_back(link);
}

void Markers::publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now) {
  if (!publisher_.has_subscribers()) return;
  if (snapshot.structure != structure_) on_structure(snapshot);
  for (const std::uint32_t link : snapshot.moved_links) mark(link);
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
  for (const std::uint32_t link : changed_) marked_[link] = false;
  changed_.clear();
  overlays_.append(snapshot, all, array);
  return array;
}

void Markers::put_link(const sim::Snapshot& snapshot, std::uint32_t link, Array& array) const {
  for (const Drawing& drawing : *links_[link]) {
    array.markers.push_back(drawing.marker);
    array.markers.back().pose = to_ros(snapshot.link_poses[link] * drawing.offset);
  }
}

}  // namespace angen::node
