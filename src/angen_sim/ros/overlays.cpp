#include "ros/overlays.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "plugin/ray_color.h"
#include "plugin/summary.h"
#include "ros/convert.h"
#include "ros/glow.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

constexpr double kNewRange = 0.15;  // m: beams are drawn again when one differs by more

const Vec3 kOverSensor(0.0, 0.0, 0.12);  // m, where its words stand in the world
const Vec3 kOverModel(0.0, 0.0, 0.5);    // m, in its first link's frame

constexpr double kTextHeight = 0.08;        // m, of a capital letter
constexpr double kRoomTextHeight = 0.45;    // m
constexpr double kDeviceTextHeight = 0.22;  // m
constexpr double kMoverTextHeight = 0.32;   // m, of a robot or person
constexpr double kRoomTextAt = 2.2;         // m over the floor, south of the lamp in its middle
constexpr double kOverDevice = 0.17;        // m, a label over the highest visual

const std::optional<RayStyle>& rays_of(const sim::SensorEntry& sensor) {
  static const std::optional<RayStyle> none;
  if (sensor.plugin->kind().ray_color.empty()) return none;
  return ros_kind(sensor.kind, sensor.desc->plugin).rays;
}

// <color>, which was checked when the sensor was made.
std_msgs::ColorRGBA color_of(const sim::SensorEntry& sensor) {
  Params params(sensor.desc->plugin_element, &sensor.desc->element);
  const Eigen::Vector4f c = read_ray_color(params, sensor.plugin->kind());
  return color(c[0], c[1], c[2], c[3]);
}

visualization_msgs::Marker text_marker(std::string text, double height,
                                       const std_msgs::ColorRGBA& ink) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.scale.z = height;
  marker.text = std::move(text);
  marker.color = ink;
  return marker;
}

/// The summary over a sensor or device, red during an alarm; empty where there is no reading yet.
visualization_msgs::Marker draw_caption(const Kind& kind, const Reading* reading) {
  const bool alarm = reading != nullptr && alarms(kind, *reading);
  return text_marker(reading != nullptr ? summary(kind, *reading) : "", kTextHeight,
                     alarm ? color(0.85F, 0.1F, 0.1F, 1.0F) : color(0.75F, 0.88F, 1.0F, 1.0F));
}

double height_of(const Shape& shape) {
  switch (shape.type) {
    case Shape::Type::kBox:
      return shape.size.z();
    case Shape::Type::kSphere:
      return 2 * shape.radius;
    case Shape::Type::kCylinder:
    case Shape::Type::kCapsule:
      return shape.length;
    default:
      return 0.0;
  }
}

/// Over the middle of its visuals, in the model's frame.
Vec3 place_of_label(const desc::Model& model) {
  Eigen::AlignedBox3d box;
  for (const desc::Link& link : model.links) {
    for (const desc::Visual& visual : link.visuals) {
      const Vec3 middle = (link.pose * visual.pose).position;
      const Vec3 top(0.0, 0.0, height_of(visual.shape) / 2);
      box.extend(middle - top).extend(middle + top);
    }
  }
  if (box.isEmpty()) return Vec3::Zero();
  return {box.center().x(), box.center().y(), box.max().z() + kOverDevice};
}

std::uint32_t first_link(const sim::Structure& structure, std::uint32_t model) {
  const auto link = std::find_if(structure.links.begin(), structure.links.end(),
                                 [&](const sim::LinkEntry& l) { return l.model == model; });
  return static_cast<std::uint32_t>(link - structure.links.begin());
}

/// Where its description puts it, whatever has moved since.
Pose described_pose(const sim::Structure& structure, std::uint32_t link) {
  const sim::LinkEntry& entry = structure.links[link];
  const desc::Model& model = *structure.models[entry.model];
  return model.pose * model.links[entry.link].pose;
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
  if (entry.model != UINT32_MAX) overlay.subject = structure.models[entry.model];
  overlay.index = light;
  overlay.link = entry.link;
  overlay.offset = entry.light.pose;
  Pose pose = entry.light.pose;
  if (entry.link != UINT32_MAX) pose = described_pose(structure, entry.link) * pose;
  overlay.storey = storey_suffix(structure, entry.model, pose.position.z());
  const bool still = entry.link == UINT32_MAX || !structure.links[entry.link].moves;
  const Room* room = still ? room_around(rooms_, pose.position) : nullptr;
  if (room != nullptr) {
    Overlay lit = overlay;
    lit.subject = nullptr;  // its room may be another
    lit.link = UINT32_MAX;
    lit.offset = {pose.position, room->pose.rotation};
    glows_.emplace(entry.name, std::move(lit));
  }
  lamps_.emplace(entry.name, std::move(overlay));
}

void Overlays::add_sensor(const sim::Structure& structure, std::uint32_t sensor) {
  const sim::SensorEntry& entry = structure.sensors[sensor];
  Overlay overlay;
  overlay.subject = entry.desc;
  overlay.index = sensor;
  overlay.link = entry.link;
  overlay.offset = entry.pose;
  overlay.storey = storey_suffix(structure, entry.model,
                                 (described_pose(structure, entry.link) * entry.pose).position.z());
  const RosKind& kind = ros_kind(entry.kind, entry.desc->plugin);
  if (kind.rays) {
    beams_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
  } else if (kind.caption && !entry.on_demand()) {
    captions_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
  }
}

void Overlays::add_device(const sim::Structure& structure, std::uint32_t device) {
  const sim::DeviceEntry& entry = structure.devices[device];
  const std::vector<Field>& fields = entry.plugin->kind().fields;
  const bool has_alarm =
      std::any_of(fields.begin(), fields.end(), [](const Field& field) { return field.alarm; });
  if (!has_alarm || !ros_kind(entry.kind, entry.library).caption) return;
  Overlay overlay;
  overlay.subject = structure.models[entry.model];
  overlay.index = device;
  overlay.of_device = true;
  overlay.link = first_link(structure, entry.model);
  overlay.offset.position = kOverModel;
  overlay.storey =
      storey_suffix(structure, entry.model, structure.models[entry.model]->pose.position.z());
  captions_.emplace(entry.kind + "/" + entry.name, std::move(overlay));
}

void Overlays::add_label(const sim::Structure& structure, std::uint32_t device) {
  const sim::DeviceEntry& entry = structure.devices[device];
  const bool travels = entry.kind == "drive" || entry.kind == "person";
  if (!travels && entry.kind != "lamp" && entry.kind != "door") return;
  const desc::Model& model = *structure.models[entry.model];
  const Vec3 place = place_of_label(model);
  Overlay overlay;
  overlay.subject = structure.models[entry.model];
  overlay.storey = storey_suffix(structure, entry.model, model.pose.position.z());
  overlay.offset.position = model.pose * place;
  if (travels) {
    overlay.link = first_link(structure, entry.model);
    overlay.offset.position = model.links.front().pose.inverse() * place;
  }
  const std::string group = entry.kind == "door" ? "door labels" : "labels";
  const std::string text = travels ? entry.name : entry.kind + " " + entry.name;
  Overlay& kept = labels_.emplace(entry.kind + "/" + entry.name, std::move(overlay)).first->second;
  show(kept,
       text_marker(text, travels ? kMoverTextHeight : kDeviceTextHeight,
                   color(1.0F, 0.9F, 0.7F, 1.0F)),
       group + kept.storey);
}

void Overlays::add_room_labels() {
  for (const Room& room : rooms_) {
    Overlay overlay;
    overlay.storey = room.storey;
    overlay.offset.position = room.pose * Vec3(0.0, -room.size.y() / 4, kRoomTextAt);
    Overlay& kept = labels_.emplace("room/" + room.building + "/" + room.name, std::move(overlay))
                        .first->second;
    show(kept, text_marker(room.name, kRoomTextHeight, color(1.0F, 1.0F, 1.0F, 1.0F)),
         "labels" + room.storey);
  }
}

void Overlays::keep_drawn(Overlay& old, Overlay& now) {
  now.marker = old.marker;
  now.pose = old.pose;
  now.drawn = old.drawn;
  now.level = old.level;
  now.last = std::move(old.last);
  now.stamp = old.stamp;
  now.ranges = std::move(old.ranges);
  now.fired = old.fired;
}

void Overlays::keep_markers(Named& old, Named& now, std::int32_t& next_id, Array& gone) {
  for (auto& [name, overlay] : now) {
    const auto before = old.find(name);
    if (before == old.end()) {
      overlay.marker.id = next_id++;
    } else if (overlay.subject != nullptr && overlay.subject == before->second.subject) {
      keep_drawn(before->second, overlay);
    } else if (overlay.marker.ns.empty()) {
      overlay.marker = before->second.marker;
    } else {
      overlay.marker.id = before->second.marker.id;
    }
  }
  for (const auto& [name, overlay] : old) {
    if (overlay.marker.ns.empty()) continue;
    const auto after = now.find(name);
    if (after == now.end() || after->second.storey != overlay.storey)
      gone.markers.push_back(overlay.marker);
  }
}

void Overlays::on_structure(const sim::Snapshot& snapshot, std::int32_t& next_id, Array& gone) {
  const sim::Structure& structure = *snapshot.structure;
  Named old[] = {std::exchange(lamps_, {}), std::exchange(glows_, {}), std::exchange(beams_, {}),
                 std::exchange(captions_, {}), std::exchange(labels_, {})};
  rooms_ = find_rooms(structure);
  for (std::uint32_t i = 0; i < structure.lights.size(); ++i) add_lamp(structure, i);
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) add_sensor(structure, i);
  for (std::uint32_t i = 0; i < structure.devices.size(); ++i) add_device(structure, i);
  for (std::uint32_t i = 0; i < structure.devices.size(); ++i) add_label(structure, i);
  add_room_labels();
  Named* const now[] = {&lamps_, &glows_, &beams_, &captions_, &labels_};
  for (std::size_t i = 0; i < std::size(now); ++i) keep_markers(old[i], *now[i], next_id, gone);
}

void Overlays::show(Overlay& overlay, visualization_msgs::Marker marker, const std::string& group) {
  const std::int32_t id = overlay.marker.id;
  if (!overlay.marker.ns.empty() && overlay.marker.ns != group)
    stale_.push_back(std::move(overlay.marker));
  overlay.marker = std::move(marker);
  overlay.marker.id = id;
  overlay.marker.ns = group;
}

void Overlays::append(const sim::Snapshot& snapshot, bool all, Array& array) {
  const auto update = [&](Overlay& overlay, bool changed, const Vec3& lift = Vec3::Zero()) {
    Pose pose = overlay.offset;
    if (overlay.link != UINT32_MAX) pose = snapshot.link_poses[overlay.link] * pose;
    const bool same = overlay.drawn && !changed && pose == overlay.pose;
    overlay.drawn = true;
    overlay.pose = pose;
    if (overlay.marker.ns.empty() || (!all && same)) return;
    overlay.marker.header.frame_id = "world";
    overlay.marker.pose = to_ros(pose);
    overlay.marker.pose.position = to_point(pose.position + lift);
    array.markers.push_back(overlay.marker);
  };
  for (auto& [name, lamp] : lamps_) update(lamp, relight(snapshot, lamp));
  for (auto& [name, lamp] : glows_) update(lamp, glow(snapshot, lamp));
  for (auto& [name, beams] : beams_) update(beams, redraw(snapshot, beams));
  for (auto& [name, caption] : captions_) update(caption, rewrite(snapshot, caption), kOverSensor);
  for (auto& [name, label] : labels_) update(label, false);
  for (visualization_msgs::Marker& marker : stale_) {
    marker.action = visualization_msgs::Marker::DELETE;
    array.markers.push_back(std::move(marker));
  }
  stale_.clear();
}

bool Overlays::relight(const sim::Snapshot& snapshot, Overlay& lamp) {
  const double level = (*snapshot.light_levels)[lamp.index];
  if (level == lamp.level) return false;
  lamp.level = level;
  show(lamp, draw(snapshot.structure->lights[lamp.index].light, level), "lights" + lamp.storey);
  return true;
}

bool Overlays::glow(const sim::Snapshot& snapshot, Overlay& lamp) {
  const double level = (*snapshot.light_levels)[lamp.index];
  if (level == lamp.level) return false;
  lamp.level = level;
  const Room* room = room_around(rooms_, lamp.offset.position);
  const desc::Light& light = snapshot.structure->lights[lamp.index].light;
  if (level > 0.0) {
    show(lamp, draw_glow(*room, lamp.offset.position, light, level), "lit rooms" + lamp.storey);
  } else {
    show(lamp, {}, "");
  }
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

bool Overlays::redraw(const sim::Snapshot& snapshot, Overlay& beams) {
  const sim::SensorEntry& entry = snapshot.structure->sensors[beams.index];
  const RayStyle& style = *rays_of(entry);
  if (!is_new(snapshot, beams) && beams.drawn) return false;
  const std::shared_ptr<const Reading> reading = snapshot.reading(beams.index);
  std::vector<double> ranges;
  bool fired = false;
  if (reading != nullptr) {
    ranges = reading->get<std::vector<double>>("ranges");
    fired = alarms(entry.plugin->kind(), *reading);
  }
  if (beams.drawn && fired == beams.fired && !apart(ranges, beams.ranges)) return false;
  beams.fired = fired;
  beams.ranges = std::move(ranges);
  visualization_msgs::Marker marker = draw_rays(*entry.desc, beams.ranges);
  marker.color = fired ? style.alarm : color_of(entry);
  show(beams, std::move(marker), (fired ? "" : "idle ") + style.group + beams.storey);
  return true;
}

bool Overlays::rewrite(const sim::Snapshot& snapshot, Overlay& caption) {
  const std::uint32_t index = caption.index;
  if (!is_new(snapshot, caption) && caption.drawn) return false;
  const std::shared_ptr<const Reading> reading =
      caption.of_device ? snapshot.devices[index] : snapshot.reading(index);
  const sim::Structure& structure = *snapshot.structure;
  const std::shared_ptr<const Plugin>& plugin =
      caption.of_device ? structure.devices[index].plugin : structure.sensors[index].plugin;
  visualization_msgs::Marker marker = draw_caption(plugin->kind(), reading.get());
  if (marker.text == caption.marker.text && marker.color == caption.marker.color) return false;
  show(caption, std::move(marker), "readings" + caption.storey);
  return true;
}

}  // namespace angen::node
