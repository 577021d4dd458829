#include "sim/view.h"

#include <cmath>
#include <initializer_list>

namespace angen::sim {

namespace {

constexpr double kBetweenRays = 0.05;  // m beside those that are watched

template <class Ref>
std::size_t at(Ref ref) {
  return static_cast<std::size_t>(ref.index);
}

DeviceView view_of(const FoundDevice& found) {
  return {found.device->kind, found.device->name, found.live->desc->name, found.pose,
          *found.device->last};
}

/// A plug-in that computes such a number fails; without it, nothing would be done, without a word.
void reject_nan(const char* call, std::initializer_list<double> values) {
  for (const double value : values) {
    if (std::isnan(value)) throw Error(std::string(call) + "() was given NaN");
  }
}

}  // namespace

Pose InstanceView::pose() const {
  if (sensor_ == nullptr) return building_.pose_of(live_);
  return engines_.physics.pose(live_.parts.links.at(sensor_->link)) * sensor_->pose;
}

JointView InstanceView::joint(JointRef joint) const {
  queried_.model = true;
  const physics::JointState state = engines_.physics.joint(live_.parts.joints.at(at(joint)));
  return {state.position, state.velocity, state.effort};
}

JointWrench InstanceView::wrench(JointRef joint) const {
  queried_.model = true;
  const physics::Wrench wrench = engines_.physics.wrench(live_.parts.joints.at(at(joint)));
  return {wrench.force, wrench.torque};
}

LinkView InstanceView::link(LinkRef link) const {
  queried_.model = true;
  const physics::LinkId id = live_.parts.links.at(at(link));
  const physics::LinkState state = engines_.physics.link(id);
  return {state.pose, state.linear_velocity, state.angular_velocity, engines_.physics.awake(id)};
}

std::vector<ContactPair> InstanceView::contacts(ContactRef collision) const {
  queried_.contacts = true;
  return engines_.physics.contacts(sensor_->touching.at(at(collision)));
}

std::vector<ContactPair> InstanceView::contacts_within(ContactRef collision,
                                                       Nanoseconds period) const {
  queried_.contacts = true;
  const std::int64_t first =
      (clock_.time - period) / clock_.step;  // the first tick that ended after then
  return engines_.physics.contacts_since(sensor_->touching.at(at(collision)), first);
}

std::vector<DeviceView> InstanceView::devices(const std::string& field,
                                              const Eigen::AlignedBox3d& within) const {
  note_query(field, {within.min().z(), within.max().z()});
  std::vector<DeviceView> found;
  const std::vector<const FoundDevice*> all = building_.find_devices(field, within);
  found.reserve(all.size());
  for (const FoundDevice* each : all) found.push_back(view_of(*each));
  return found;
}

std::optional<DeviceView> InstanceView::device(const std::string& field, const std::string& kind,
                                               const std::string& name) const {
  const std::optional<FoundDevice> found = building_.find_device(field, kind, name);
  note_query(field, found ? found->heights() : Heights{});  // all count if it comes
  if (!found) return std::nullopt;
  return view_of(*found);
}

bool InstanceView::has_device(const std::string& field, const std::string& kind,
                              const std::string& name) const {
  queried_.devices = true;
  return building_.find_device(field, kind, name).has_value();
}

void InstanceView::note_query(const std::string& field, const Heights& heights) const {
  queried_.devices = true;
  queried_.fields |= engines_.states.bit_of(field);
  queried_.heights = queried_.heights | heights;
}

const Home& InstanceView::home() const {
  queried_.devices = true;  // it changes when models come or go
  return building_.home();
}

const rays::Scene& InstanceView::rays() const {
  queried_.other = queried_.other || !watches();
  engines_.rays.commit();
  return engines_.rays;
}

std::vector<std::uint32_t> InstanceView::own_shapes() const {
  queried_.model = true;  // they move with its links
  std::vector<std::uint32_t> shapes;
  for (const Parts::Shape& shape : live_.parts.shapes) shapes.push_back(shape.id.index);
  return shapes;
}

std::string InstanceView::model_of(std::uint32_t shape) const {
  queried_.other = true;
  for (const std::unique_ptr<LiveModel>& live : building_.models()) {
    for (const Parts::Shape& each : live->parts.shapes) {
      if (each.id.index == shape) return live->desc->name;
    }
  }
  return "";
}

light::Sample InstanceView::illuminance(light::Probe& probe, const Pose& pose) const {
  queried_.other = queried_.other || queried_.light;  // only one place's light is watched
  queried_.light = true;
  if (engines_.light.dark() && engines_.light.knows(probe))
    return engines_.light.measure(probe, pose);
  engines_.rays.commit();
  engines_.light.keep_time();
  if (sensor_ == nullptr) return engines_.light.measure(probe, pose);
  std::unique_ptr<WatchedLight>& watched = sensor_->light;
  const bool still =
      watched && watched->probe == &probe && !watched->region.changed_since(watched->sampled);
  light::Sample sample = engines_.light.measure(probe, pose, still);
  if (!probe.reach.diagonal().allFinite()) {
    watched = nullptr;
  } else if (!still || probe.reach.min() != watched->box.min() ||
             probe.reach.max() != watched->box.max()) {
    watched.reset(new WatchedLight{&probe, {engines_.movers, probe.reach}, probe.reach, 0});
  }
  if (watched) watched->sampled = engines_.movers.now() + 1;
  return sample;
}

const std::vector<rays::WarmShape>& InstanceView::warm_shapes() const {
  queried_.heat = true;
  engines_.surfaces.advance(clock_.time, engines_.movers.now());
  return rays().warm_shapes();
}

Revisions InstanceView::watch(const std::function<std::vector<rays::Ray>()>& make) const {
  queried_.heat_set = true;
  const std::uint64_t temperatures = engines_.surfaces.times_set();
  if (sensor_ == nullptr || sensor_->link_moves) return {rays().revision(), temperatures};
  std::unique_ptr<WatchedRays>& near = sensor_->near;
  if (near == nullptr || near->region.take_static_change()) {
    engines_.rays.commit();
    Eigen::AlignedBox3d reach = rays::RayCache(make(), engines_.rays).reach();
    reach.min().array() -= kBetweenRays;
    reach.max().array() += kBetweenRays;
    if (near == nullptr) {
      near.reset(new WatchedRays{{engines_.movers, reach}, reach, 0});
    } else {
      near->region.resize(reach);
      near->box = reach;
    }
    ++near->revision;
  }
  if (near->region.changed_since(sensor_->seen)) ++near->revision;
  return {near->revision, temperatures};
}

std::vector<std::uint8_t> InstanceView::colors(const render::PinholeCamera& lens,
                                               const Pose& pose) const {
  queried_.other = true;
  render::Ambience ambience = engines_.ambience;
  // Pictures use only light that is known already: subscriptions of a camera must not
  // change the readings of other sensors.
  if (engines_.light.keeps_time()) ambience.reflected = engines_.light.reflected();
  engines_.follow_limbs();
  return engines_.visuals.colors(lens, pose, engines_.light.lit(), ambience);
}

std::vector<float> InstanceView::depths(const render::PinholeCamera& lens, const Pose& pose) const {
  queried_.other = true;
  engines_.follow_limbs();
  return engines_.visuals.depths(lens, pose);
}

void InstanceOutputs::force(JointRef joint, double force) {
  reject_nan("force", {force});
  engines_.physics.add_force(live_.parts.joints.at(at(joint)), force);
}

void InstanceOutputs::motor(JointRef joint, double velocity, double max_force) {
  reject_nan("motor", {velocity, max_force});
  engines_.physics.set_motor(live_.parts.joints.at(at(joint)), velocity, max_force);
}

void InstanceOutputs::latch(JointRef joint, double break_force) {
  reject_nan("latch", {break_force});
  engines_.physics.latch(live_.parts.joints.at(at(joint)), break_force);
}

void InstanceOutputs::unlatch(JointRef joint) {
  engines_.physics.unlatch(live_.parts.joints.at(at(joint)));
}

void InstanceOutputs::drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) {
  reject_nan("drive", {velocity.sum(), yaw_rate, max_force});
  engines_.physics.drive(live_.parts.links.at(at(link)), velocity, yaw_rate, max_force);
}

void InstanceOutputs::push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) {
  reject_nan("push", {force.sum(), torque.sum(), point.sum()});
  engines_.physics.push(live_.parts.links.at(at(link)), force, torque, point);
}

void InstanceOutputs::posture(LinkRef link, int posture, const Pose& pose) {
  engines_.take_posture(live_.parts, static_cast<std::uint32_t>(at(link)), posture, pose);
  building_.note_states(live_, engines_.movers.now());
}

void InstanceOutputs::light(LightRef light, double level, double luminous_flux) {
  Parts::Lamp& lamp = live_.parts.lamps.at(at(light));
  lamp.level = level;
  engines_.light.set_level(lamp.id, level * luminous_flux / lamp.nominal_flux);
  engines_.note_change();
  lights_changed_ = true;
}

void InstanceOutputs::temperature(SurfaceRef surface, double now, double limit,
                                  double time_constant) {
  for (const Parts::Shape& shape : live_.parts.shapes) {
    if (shape.surface != surface.index) continue;
    engines_.surfaces.set(shape.id, now, limit, time_constant, time_, engines_.movers.now());
    engines_.movers.warm(engines_.rays.bounds(shape.id));
  }
}

void InstanceOutputs::event(const std::string& event, const std::string& detail) {
  events_.push_back({time_, device_.name, device_.kind, event, detail});
  had_event_ = true;
}

}  // namespace angen::sim
