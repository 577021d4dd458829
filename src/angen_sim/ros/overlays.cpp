#include "ros/overlays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "ros/captions.h"
#include "ros/convert.h"

namespace angen::node {
namespace {

constexpr double kNewRange = 0.15;  // m: beams are drawn again when one differs by more

const Vec3 kOverSensor(0.0, 0.0, 0.12);  // m, where its words stand in the world
const Vec3 kOverModel(0.0, 0.0, 0.5);    // m, in its first link's frame

/// How the beams of a kind of sensor are shown.
struct Beams {
  const char* group;
  const char* flag;  // the field that is true while it sees what it looks for
  std_msgs::ColorRGBA idle;
  std_msgs::ColorRGBA fired;
};

const Beams* beams_of(const std::string& kind) {
  static const std::map<std::string, Beams> kinds = {
      {"pir",
       {"PIR rays", "motion", color(0.1F, 0.3F, 1.0F, 0.45F), color(1.0F, 0.25F, 0.1F, 0.8F)}},
      {"switch",
       {"switch beams", "closed", color(0.9F, 0.1F, 0.1F, 1.0F), color(0.1F, 0.8F, 0.2F, 1.0F)}},
      {"proximity",
       {"proximity cones", "near", color(0.1F, 0.5F, 0.9F, 0.45F), color(0.9F, 0.5F, 0.1F, 0.8F)}},
  };
  const auto found = kinds.find(kind);
  return found == kinds.end() ? nullptr : &found->second;
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
  if (beams_of(entry.kind) != nullptr) {
    beams_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
  } else if (has_caption(entry.kind)) {
    captions_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
  }
}

void Overlays::add_device(const sim::Structure& structure, std::uint32_t device) {
  const sim::DeviceEntry& entry = structure.devices[device];
  if (!has_caption(entry.kind)) return;
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

bool Overlays::tells_anew(const sim::Snapshot& snapshot, Overlay& overlay) {
  const std::uint32_t index = overlay.index;
  const auto& told = overlay.of_device ? snapshot.devices[index] : snapshot.sensors[index].reading;
  const bool is_lazy = !overlay.of_device && snapshot.sensors[index].lazy != nullptr;
  const Nanoseconds stamp = is_lazy ? snapshot.stamp(index) : 0;
  if (told == overlay.told && stamp == overlay.stamp) return false;
  overlay.told = told;
  overlay.stamp = stamp;
  return true;
}

bool Overlays::redraw(const sim::Snapshot& snapshot, Overlay& beams) const {
  const sim::SensorEntry& entry = snapshot.structure->sensors[beams.index];
  const Beams& style = *beams_of(entry.kind);
  const bool first = beams.marker.points.empty();
  if (!tells_anew(snapshot, beams) && !first) return false;
  const std::shared_ptr<const Reading> reading = snapshot.reading(beams.index);
  std::vector<double> ranges;
  bool fired = false;
  if (reading != nullptr) {
    ranges = reading->get<std::vector<double>>("ranges");
    fired = reading->get<bool>(style.flag);
  }
  if (!first && fired == beams.fired && !apart(ranges, beams.ranges)) return false;
  beams.fired = fired;
  beams.ranges = std::move(ranges);
  const std::int32_t id = beams.marker.id;
  beams.marker = draw_rays(*entry.desc, beams.ranges);
  beams.marker.ns = style.group;
  beams.marker.id = id;
  beams.marker.color = fired ? style.fired : style.idle;
  return true;
}

bool Overlays::rewrite(const sim::Snapshot& snapshot, Overlay& caption) const {
  const std::uint32_t index = caption.index;
  if (!tells_anew(snapshot, caption) && !caption.marker.ns.empty()) return false;
  const std::shared_ptr<const Reading> reading =
      caption.of_device ? snapshot.devices[index] : snapshot.reading(index);
  const std::int32_t id = caption.marker.id;
  const visualization_msgs::Marker before = std::move(caption.marker);
  const sim::Structure& structure = *snapshot.structure;
  const std::string& kind =
      caption.of_device ? structure.devices[index].kind : structure.sensors[index].kind;
  caption.marker = draw_caption(kind, reading.get());
  caption.marker.ns = "readings";
  caption.marker.id = id;
  return caption.marker.text != before.text || caption.marker.color != before.color;
}

}  // namespace angen::node
