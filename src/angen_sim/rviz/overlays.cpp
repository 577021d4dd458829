#include "rviz/overlays.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "plugin/ray_geometry.h"
#include "plugin/summary.h"
#include "ros/convert.h"
#include "ros/ros_kind.h"
#include "scene/groups.h"

namespace angen::node {
namespace {

constexpr double kNewRange = 0.15;  // m: beams are drawn again when one differs by more

const Vec3 kOverSensor(0.0, 0.0, 0.12);  // m, of its caption, in the world
const Vec3 kOverModel(0.0, 0.0, 0.5);    // m, in its first link's frame

constexpr double kTextHeight = 0.08;        // m, of a capital letter
constexpr double kRoomTextHeight = 0.45;    // m
constexpr double kDeviceTextHeight = 0.22;  // m
constexpr double kMoverTextHeight = 0.32;   // m, of a robot or person
constexpr double kRoomTextAt = 2.2;         // m over the floor, south of the lamp in its middle
constexpr double kOverDevice = 0.17;        // m, a label over the highest visual

const std::optional<RayStyle>& rays_of(const sim::SensorEntry& sensor) {
  static const std::optional<RayStyle> none;
  if (sensor.rays == nullptr || sensor.plugin->kind().ray_color().empty()) return none;
  return ros_kind(sensor).rays;
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

/// The summary over a sensor or device, red during an alarm; empty if there is no reading yet.
visualization_msgs::Marker draw_caption(const Kind& kind, const Reading* reading, bool alarm) {
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

/// Its pose by its description, before any motion.
Pose described_pose(const sim::Structure& structure, std::uint32_t link) {
  const sim::LinkEntry& entry = structure.links[link];
  return structure.models[entry.model]->pose * structure.described(entry).pose;
}

Pose described_pose(const sim::Structure& structure, const sim::LightEntry& light) {
  if (light.link == UINT32_MAX) return light.light.pose;
  return described_pose(structure, light.link) * light.light.pose;
}

/// The lit faces of a room: those on the outermost walls by " south", …, all others by "".
std::map<std::string, std::vector<LitFace>> faces_by_side(const sim::Structure& structure,
                                                          const Room& room) {
  std::map<std::string, std::vector<LitFace>> found;
  for (const LitFace& face : lit_faces(room)) {
    Eigen::AlignedBox3d box(face.corner);
    box.extend(face.corner + face.u + face.v);
    const std::string side = scene::outer_side(structure, box);
    found[side.empty() ? "" : " " + side].push_back(face);
  }
  return found;
}

bool apart(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > kNewRange) return true;
  }
  return false;
}

}  // namespace

Overlays::Overlay& Overlays::put(Named& all, const std::string& name, Overlay overlay) {
  const auto [at, is_new] = all.emplace(name, std::move(overlay));
  if (is_new) at->second.marker.id = next_id_++;
  return at->second;
}

void Overlays::add_lamp(const sim::Structure& structure, std::uint32_t light) {
  const sim::LightEntry& entry = structure.lights[light];
  if (entry.light.type == desc::Light::Type::kDirectional) return;
  Overlay overlay;
  overlay.of = Of::kLight;
  overlay.index = light;
  overlay.link = entry.link;
  overlay.offset = entry.light.pose;
  const Pose pose = described_pose(structure, entry);
  overlay.storey = scene::storey_suffix(structure, entry.model, pose.position.z());
  put(lamps_, entry.name, std::move(overlay));
}

void Overlays::add_glow(const sim::Structure& structure, std::uint32_t light) {
  const sim::LightEntry& entry = structure.lights[light];
  if (entry.light.type == desc::Light::Type::kDirectional) return;
  if (entry.link != UINT32_MAX && structure.links[entry.link].moves) return;
  const Vec3 place = described_pose(structure, entry).position;
  const Room* room = home_->get().room_at(place);
  if (room == nullptr) return;
  Overlay overlay;
  overlay.of = Of::kLight;
  overlay.index = light;
  overlay.offset.position = place;
  const std::string storey = scene::storey_suffix(structure, entry.model, place.z());
  for (auto& [side, faces] : faces_by_side(structure, *room)) {
    overlay.storey = side + storey;
    overlay.faces = std::move(faces);
    put(glows_, entry.name + side, overlay);
  }
}

void Overlays::add_sensor(const sim::Structure& structure, std::uint32_t sensor) {
  const sim::SensorEntry& entry = structure.sensors[sensor];
  Overlay overlay;
  overlay.of = Of::kSensor;
  overlay.index = sensor;
  overlay.link = entry.link;
  overlay.offset = entry.pose;
  overlay.storey = scene::storey_suffix(
      structure, entry.model, (described_pose(structure, entry.link) * entry.pose).position.z());
  const RosKind& kind = ros_kind(entry);
  if (rays_of(entry)) {
    put(beams_, sim::full_name(entry), std::move(overlay));
  } else if (kind.caption && !entry.on_demand()) {
    put(captions_, sim::full_name(entry), std::move(overlay));
  }
}

void Overlays::add_device(const sim::Structure& structure, std::uint32_t device) {
  const sim::DeviceEntry& entry = structure.devices[device];
  const std::vector<Field>& fields = entry.plugin->kind().fields;
  const bool has_alarm =
      std::any_of(fields.begin(), fields.end(), [](const Field& field) { return field.alarm; });
  if (!has_alarm || !ros_kind(entry).caption) return;
  Overlay overlay;
  overlay.of = Of::kDevice;
  overlay.index = device;
  overlay.link = structure.first_link(entry.model);
  overlay.offset.position = kOverModel;
  overlay.storey = scene::storey_suffix(structure, entry.model,
                                        structure.models[entry.model]->pose.position.z());
  put(captions_, sim::full_name(entry), std::move(overlay));
}

void Overlays::add_label(const sim::Structure& structure, std::uint32_t device) {
  const sim::DeviceEntry& entry = structure.devices[device];
  const std::string& label = ros_kind(entry).label;
  const bool travels = entry.plugin->kind().travels();
  if (label.empty()) return;
  if (entry.light != UINT32_MAX) return;  // a sun needs none
  const desc::Model& model = *structure.models[entry.model];
  const Vec3 place = place_of_label(model);
  Overlay overlay;
  overlay.of = Of::kDevice;
  overlay.index = device;
  overlay.storey = scene::storey_suffix(structure, entry.model, model.pose.position.z());
  overlay.offset.position = model.pose * place;
  if (travels) {
    overlay.link = structure.first_link(entry.model);
    overlay.offset.position = model.links.front().pose.inverse() * place;
  }
  const std::string text = travels ? entry.name : entry.kind + " " + entry.name;
  Overlay& kept = put(labels_, sim::full_name(entry), std::move(overlay));
  show(kept,
       text_marker(text, travels ? kMoverTextHeight : kDeviceTextHeight,
                   color(1.0F, 0.9F, 0.7F, 1.0F)),
       label + kept.storey);
}

void Overlays::add_room_labels() {
  for (const Room& room : home_->get().rooms) {
    Eigen::AlignedBox2d around;
    for (const Point2& corner : room.outline) around.extend(corner);
    const Point2 middle = around.center() - Point2(0.0, around.sizes().y() / 4);
    Overlay overlay;
    overlay.storey = " " + std::to_string(room.storey);
    overlay.offset.position = {middle.x(), middle.y(), room.floor + kRoomTextAt};
    Overlay& kept = put(room_labels_, room.model + "/" + room.name, std::move(overlay));
    show(kept, text_marker(room.name, kRoomTextHeight, color(1.0F, 1.0F, 1.0F, 1.0F)),
         "labels" + kept.storey);
  }
}

void Overlays::drop(Named& all, Array& removed) {
  for (auto& [name, overlay] : all) {
    if (!overlay.marker.ns.empty()) removed.markers.push_back(std::move(overlay.marker));
  }
  all.clear();
}

void Overlays::keep(Named& all, const Changes& changes, Array& removed) {
  for (auto at = all.begin(); at != all.end();) {
    Overlay& overlay = at->second;
    const Numbers& numbers = overlay.of == Of::kLight    ? changes.lights
                             : overlay.of == Of::kSensor ? changes.sensors
                                                         : changes.devices;
    overlay.index = numbers.after[overlay.index];
    if (overlay.index == Numbers::kNone) {
      if (!overlay.marker.ns.empty()) removed.markers.push_back(std::move(overlay.marker));
      at = all.erase(at);
      continue;
    }
    if (overlay.link != UINT32_MAX) overlay.link = changes.links.after[overlay.link];
    ++at;
  }
}

void Overlays::on_structure(const sim::Structure& structure, const Changes& changes,
                            Array& removed) {
  const bool other_rooms = home_ != structure.home;
  if (other_rooms) {
    home_ = structure.home;
    drop(room_labels_, removed);
    drop(glows_, removed);
    add_room_labels();
  }
  for (Named* all : {&lamps_, &glows_, &beams_, &captions_, &labels_}) keep(*all, changes, removed);
  const auto is_new = [](const Numbers& numbers, std::uint32_t i) {
    return numbers.before[i] == Numbers::kNone;
  };
  for (std::uint32_t i = 0; i < structure.lights.size(); ++i) {
    if (is_new(changes.lights, i)) add_lamp(structure, i);
    if (other_rooms || is_new(changes.lights, i)) add_glow(structure, i);
  }
  for (std::uint32_t i = 0; i < structure.sensors.size(); ++i) {
    if (is_new(changes.sensors, i)) add_sensor(structure, i);
  }
  for (std::uint32_t i = 0; i < structure.devices.size(); ++i) {
    if (!is_new(changes.devices, i)) continue;
    add_device(structure, i);
    add_label(structure, i);
  }
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
  for (auto& [name, label] : room_labels_) update(label, false);
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
  const Room* room = home_->get().room_at(lamp.offset.position);
  const desc::Light& light = snapshot.structure->lights[lamp.index].light;
  if (level > 0.0) {
    show(lamp, draw_glow(*room, lamp.faces, lamp.offset.position, light, level),
         "lit rooms" + lamp.storey);
  } else {
    show(lamp, {}, "");
  }
  return true;
}

bool Overlays::is_new(const sim::Snapshot& snapshot, Overlay& overlay) {
  const std::uint32_t index = overlay.index;
  const bool is_device = overlay.of == Of::kDevice;
  const auto& last = is_device ? snapshot.devices[index] : snapshot.sensors[index].reading;
  const bool lazy = !is_device && snapshot.sensors[index].lazy != nullptr;
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
  const std::shared_ptr<const Reading> reading = readings_.of(snapshot, beams.index);
  std::vector<double> ranges;
  double tilt = 0.0;
  bool fired = false;
  if (reading != nullptr) {
    tilt = entry.rays->tilt(entry.schedule.samples_before(snapshot.stamp(beams.index)));
    ranges = reading->get<std::vector<double>>("ranges", {});
    fired = alarms(entry.plugin->kind(), *reading);
  }
  const bool same = fired == beams.fired && tilt == beams.tilt && !apart(ranges, beams.ranges);
  if (beams.drawn && same) return false;
  beams.fired = fired;
  beams.tilt = tilt;
  beams.ranges = std::move(ranges);
  visualization_msgs::Marker marker = draw_rays(*entry.rays, tilt, beams.ranges);
  marker.color = fired ? style.alarm : color_of(entry);
  show(beams, std::move(marker), (fired ? "" : "idle ") + style.group + beams.storey);
  return true;
}

bool Overlays::rewrite(const sim::Snapshot& snapshot, Overlay& caption) {
  const std::uint32_t index = caption.index;
  const bool is_device = caption.of == Of::kDevice;
  if (!is_new(snapshot, caption) && caption.drawn) return false;
  const std::shared_ptr<const Reading> reading =
      is_device ? snapshot.devices[index] : readings_.of(snapshot, index);
  const sim::Structure& structure = *snapshot.structure;
  const std::shared_ptr<const Plugin>& plugin =
      is_device ? structure.devices[index].plugin : structure.sensors[index].plugin;
  const bool alarm = reading != nullptr && alarms(plugin->kind(), *reading);
  visualization_msgs::Marker marker = draw_caption(plugin->kind(), reading.get(), alarm);
  if (marker.text == caption.marker.text && marker.color == caption.marker.color) return false;
  show(caption, std::move(marker), (alarm ? "alarms" : "readings") + caption.storey);
  return true;
}

}  // namespace angen::node
