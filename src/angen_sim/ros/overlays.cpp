#include "ros/overlays.h"

#include <cmath>
#include <utility>

#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr double kNewRange = 0.15;  // m: beams are drawn again when one differs by more

bool has_beams(const sim::SensorEntry& sensor) {
  return sensor.kind == "pir" || sensor.kind == "switch";
}

std_msgs::ColorRGBA beam_color(const std::string& kind, bool fired) {
  if (kind == "switch")
    return fired ? color(0.1F, 0.8F, 0.2F, 1.0F) : color(0.9F, 0.1F, 0.1F, 1.0F);
  return fired ? color(1.0F, 0.25F, 0.1F, 0.8F) : color(0.1F, 0.3F, 1.0F, 0.45F);
}

bool apart(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > kNewRange) return true;
  }
  return false;
}

}  // namespace

void Overlays::add_lamp(const sim::Structure& structure, std::uint32_t light) {
  const sim::LightEntry& entry = structure.lights[light];
  if (entry.light.type == desc::Light::Type::kDirectional) return;
  Overlay overlay;
  overlay.index = light;
  overlay.link = entry.link;
  overlay.offset = entry.light.pose;
  lamps_.emplace(entry.name, std::move(overlay));
}

void Overlays::add_beams(const sim::Structure& structure, std::uint32_t sensor) {
  const sim::SensorEntry& entry = structure.sensors[sensor];
  if (!has_beams(entry)) return;
  Overlay overlay;
  overlay.index = sensor;
  overlay.link = entry.link;
  overlay.offset = entry.pose;
  beams_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
}

void Overlays::follow(const sim::Snapshot& snapshot, std::int32_t& next_id, Array& gone) {
  const sim::Structure& structure = *snapshot.structure;
  const Named old_lamps = std::exchange(lamps_, {});
  const Named old_beams = std::exchange(beams_, {});
  for (std::uint32_t i = 0; i < structure.lights.size(); ++i) add_lamp(structure, i);
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) add_beams(structure, i);
  for (const auto& [old, now] : {std::pair(&old_lamps, &lamps_), std::pair(&old_beams, &beams_)}) {
    for (auto& [name, overlay] : *now) {
      const auto before = old->find(name);
      overlay.marker.id = before != old->end() ? before->second.marker.id : next_id++;
    }
    for (const auto& [name, overlay] : *old) {
      if (now->count(name) > 0) continue;
      gone.markers.push_back(overlay.marker);
    }
  }
}

void Overlays::append(const sim::Snapshot& snapshot, bool all, Array& array) {
  const auto update = [&](Overlay& overlay, bool changed) {
    Pose pose = overlay.offset;
    if (overlay.link != UINT32_MAX) pose = snapshot.link_poses[overlay.link] * pose;
    if (!all && !changed && pose == overlay.pose) return;
    overlay.pose = pose;
    overlay.marker.header.frame_id = "world";
    overlay.marker.pose = to_ros(pose);
    array.markers.push_back(overlay.marker);
  };
  for (auto& [name, lamp] : lamps_) update(lamp, relight(snapshot, lamp));
  for (auto& [name, beams] : beams_) update(beams, redraw(snapshot, beams));
}

bool Overlays::relight(const sim::Snapshot& snapshot, Overlay& lamp) const {
  const double level = (*snapshot.light_levels)[lamp.index];
  if (level == lamp.level) return false;
  lamp.level = level;
  const std::int32_t id = lamp.marker.id;
  lamp.marker = draw(snapshot.structure->lights[lamp.index].light, level);
  lamp.marker.ns = "lights";
  lamp.marker.id = id;
  return true;
}

bool Overlays::redraw(const sim::Snapshot& snapshot, Overlay& beams) const {
  const sim::SensorEntry& entry = snapshot.structure->sensors[beams.index];
  const std::shared_ptr<const Reading>& reading = snapshot.sensors[beams.index];
  const bool first = beams.marker.points.empty();
  if (reading == beams.reading && !first) return false;
  beams.reading = reading;
  std::vector<double> ranges;
  bool fired = false;
  if (reading != nullptr) {
    ranges = reading->get<std::vector<double>>("ranges");
    fired = reading->get<bool>(entry.kind == "pir" ? "motion" : "closed");
  }
  if (!first && fired == beams.fired && !apart(ranges, beams.ranges)) return false;
  beams.fired = fired;
  beams.ranges = std::move(ranges);
  const std::int32_t id = beams.marker.id;
  beams.marker = draw_rays(*entry.desc, beams.ranges);
  beams.marker.ns = entry.kind == "pir" ? "PIR rays" : "switch beams";
  beams.marker.id = id;
  beams.marker.color = beam_color(entry.kind, fired);
  return true;
}

}  // namespace angen::node
