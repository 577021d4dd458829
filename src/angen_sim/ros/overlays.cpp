#include "ros/overlays.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "plugin/summary.h"
#include "ros/convert.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

constexpr double kNewRange = 0.15;  // m: beams are drawn again when one differs by more

const Vec3 kOverSensor(0.0, 0.0, 0.12);  // m, where its words stand in the world
const Vec3 kOverModel(0.0, 0.0, 0.5);    // m, in its first link's frame

constexpr double kTextHeight = 0.08;  // m, of a capital letter

const std::optional<RayStyle>& rays_of(const sim::SensorEntry& sensor) {
  return ros_kind(sensor.kind, sensor.desc->plugin).rays;
}

/// The summary over a sensor or device, red during an alarm; empty where there is no reading yet.
visualization_msgs::Marker draw_caption(const Kind& kind, const Reading* reading) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.ns = "readings";
  marker.scale.z = kTextHeight;
  if (reading != nullptr) marker.text = summary(kind, *reading);
  const bool alarm = reading != nullptr && alarms(kind, *reading);
  marker.color = alarm ? color(0.85F, 0.1F, 0.1F, 1.0F) : color(0.1F, 0.15F, 0.3F, 1.0F);
  return marker;
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

void Overlays::add_sensor(const sim::Structure& structure, std::uint32_t sensor) {
  const sim::SensorEntry& entry = structure.sensors[sensor];
  Overlay overlay;
  overlay.index = sensor;
  overlay.link = entry.link;
  overlay.offset = entry.pose;
  const RosKind& kind = ros_kind(entry.kind, entry.desc->plugin);
  if (kind.rays) {
    beams_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
  } else if (kind.caption && !entry.on_demand) {
    captions_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
  }
}

void Overlays::add_device(const sim::Structure& structure, std::uint32_t device) {
  const sim::DeviceEntry& entry = structure.devices[device];
  const std::vector<Field>& fields = entry.plugin->kind().fields;
  const bool has_alarm =
      std::any_of(fields.begin(), fields.end(), [](const Field& field) { return field.alarm; });
  if (!has_alarm || !ros_kind(entry.kind, entry.library).caption) return;
  const auto link = std::find_if(structure.links.begin(), structure.links.end(),
                                 [&](const sim::LinkEntry& l) { return l.model == entry.model; });
  Overlay overlay;
  overlay.index = device;
  overlay.of_device = true;
  overlay.link = static_cast<std::uint32_t>(link - structure.links.begin());
  overlay.offset.position = kOverModel;
  captions_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
}

void Overlays::on_structure(const sim::Snapshot& snapshot, std::int32_t& next_id, Array& gone) {
  const sim::Structure& structure = *snapshot.structure;
  const Named old_lamps = std::exchange(lamps_, {});
  const Named old_beams = std::exchange(beams_, {});
  const Named old_captions = std::exchange(captions_, {});
  for (std::uint32_t i = 0; i < structure.lights.size(); ++i) add_lamp(structure, i);
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) add_sensor(structure, i);
  for (std::uint32_t i = 0; i < structure.devices.size(); ++i) add_device(structure, i);
  for (const auto& [old, now] : {std::pair(&old_lamps, &lamps_), std::pair(&old_beams, &beams_),
                                 std::pair(&old_captions, &captions_)}) {
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
    if (!overlay.marker.text.empty())
      overlay.marker.pose.position = to_point(pose.position + kOverSensor);
    array.markers.push_back(overlay.marker);
  };
  for (auto& [name, lamp] : lamps_) update(lamp, relight(snapshot, lamp));
  for (auto& [name, beams] : beams_) update(beams, redraw(snapshot, beams));
  for (auto& [name, caption] : captions_) update(caption, rewrite(snapshot, caption));
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

bool Overlays::is_new(const sim::Snapshot& snapshot, Overlay& overlay) {
  const std::uint32_t index = overlay.index;
  const auto& last = overlay.of_device ? snapshot.devices[index] : snapshot.sensors[index].reading;
  const bool lazy = !overlay.of_device && snapshot.sensors[index].lazy != nullptr;
  const Nanoseconds stamp = lazy ? snapshot.stamp(index) : 0;
  if (last == overlay.last && stamp == overlay.stamp) return false;
  overlay.last = last;
  overlay.stamp = stamp;
  return true;
}

bool Overlays::redraw(const sim::Snapshot& snapshot, Overlay& beams) const {
  const sim::SensorEntry& entry = snapshot.structure->sensors[beams.index];
  const RayStyle& style = *rays_of(entry);
  const bool first = beams.marker.points.empty();
  if (!is_new(snapshot, beams) && !first) return false;
  const std::shared_ptr<const Reading> reading = snapshot.reading(beams.index);
  std::vector<double> ranges;
  bool fired = false;
  if (reading != nullptr) {
    ranges = reading->get<std::vector<double>>("ranges");
    fired = alarms(entry.plugin->kind(), *reading);
  }
  if (!first && fired == beams.fired && !apart(ranges, beams.ranges)) return false;
  beams.fired = fired;
  beams.ranges = std::move(ranges);
  const std::int32_t id = beams.marker.id;
  beams.marker = draw_rays(*entry.desc, beams.ranges);
  beams.marker.ns = style.group;
  beams.marker.id = id;
  beams.marker.color = fired ? style.alarm : style.idle;
  return true;
}

bool Overlays::rewrite(const sim::Snapshot& snapshot, Overlay& caption) const {
  const std::uint32_t index = caption.index;
  if (!is_new(snapshot, caption) && !caption.marker.ns.empty()) return false;
  const std::shared_ptr<const Reading> reading =
      caption.of_device ? snapshot.devices[index] : snapshot.reading(index);
  const std::int32_t id = caption.marker.id;
  const visualization_msgs::Marker before = std::move(caption.marker);
  const sim::Structure& structure = *snapshot.structure;
  const std::shared_ptr<const Plugin>& plugin =
      caption.of_device ? structure.devices[index].plugin : structure.sensors[index].plugin;
  caption.marker = draw_caption(plugin->kind(), reading.get());
  caption.marker.id = id;
  return caption.marker.text != before.text || caption.marker.color != before.color;
}

}  // namespace angen::node
