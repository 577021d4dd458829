#include "sim/view.h"

#include <utility>

namespace angen::sim {

namespace {

template <class Ref>
std::size_t at(Ref ref) {
  return static_cast<std::size_t>(ref.index);
}

}  // namespace

Pose InstanceView::pose() const {
  if (sensor_ == nullptr) return building_.pose_of(live_);
  return stage_.physics.link(live_.parts.links.at(sensor_->link)).pose * sensor_->pose;
}

JointView InstanceView::joint(JointRef joint) const {
  asked_.other = true;
  const physics::JointState state = stage_.physics.joint(live_.parts.joints.at(at(joint)));
  return {state.position, state.velocity, state.effort};
}

LinkView InstanceView::link(LinkRef link) const {
  asked_.other = true;
  const physics::LinkId id = live_.parts.links.at(at(link));
  const physics::LinkState state = stage_.physics.link(id);
  return {state.pose, state.linear_velocity, state.angular_velocity, stage_.physics.awake(id)};
}

std::vector<ContactPair> InstanceView::contacts(ContactRef collision) const {
  asked_.contacts = true;
  return stage_.physics.contacts(sensor_->touching.at(at(collision)));
}

std::vector<DeviceView> InstanceView::devices(const std::string& field,
                                              const Eigen::AlignedBox3d& within) const {
  asked_.devices = asked_.other = true;
  std::vector<DeviceView> found;
  const std::vector<Building::Teller> tellers = building_.tellers(field, within);
  found.reserve(tellers.size());
  for (const Building::Teller& t : tellers) {
    found.push_back({t.device->kind, t.device->name, t.live->desc->name, t.pose, *t.device->last});
  }
  return found;
}

light::Sample InstanceView::illuminance(light::Probe& probe, const Pose& pose) const {
  asked_.other = asked_.other || asked_.light;  // only one place's light is watched
  asked_.light = true;
  if (stage_.light.dark()) return stage_.light.measure(probe, pose);
  stage_.rays.commit();
  if (sensor_ == nullptr) return stage_.light.measure(probe, pose);
  std::unique_ptr<LightWays>& ways = sensor_->light;
  const bool still = ways && ways->probe == &probe && !ways->view.stirred(ways->looked);
  const light::Sample sample = stage_.light.measure(probe, pose, still);
  if (!probe.reach.diagonal().allFinite()) {
    ways = nullptr;
  } else if (!still || probe.reach.min() != ways->box.min() ||
             probe.reach.max() != ways->box.max()) {
    ways.reset(new LightWays{&probe, {stage_.sights, probe.reach}, probe.reach, 0});
  }
  if (ways) ways->looked = stage_.sights.now() + 1;
  return sample;
}

const std::vector<rays::WarmShape>& InstanceView::warm_shapes() const {
  asked_.other = true;
  stage_.rays.commit();
  return stage_.rays.warm_shapes();
}

std::uint64_t InstanceView::scene_revision() const {
  asked_.other = true;
  stage_.rays.commit();
  return stage_.rays.revision();
}

std::vector<std::uint8_t> InstanceView::colors(const render::Lens& lens, const Pose& pose) const {
  asked_.other = true;
  return stage_.visuals.colors(lens, pose, stage_.light.lit(), stage_.ambience);
}

std::vector<float> InstanceView::depths(const render::Lens& lens, const Pose& pose) const {
  asked_.other = true;
  return stage_.visuals.depths(lens, pose);
}

void InstanceOutputs::force(JointRef joint, double force) {
  stage_.physics.add_force(live_.parts.joints.at(at(joint)), force);
}

void InstanceOutputs::motor(JointRef joint, double velocity, double max_force) {
  stage_.physics.set_motor(live_.parts.joints.at(at(joint)), velocity, max_force);
}

void InstanceOutputs::drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) {
  stage_.physics.drive(live_.parts.links.at(at(link)), velocity, yaw_rate, max_force);
}

void InstanceOutputs::light(LightRef light, double level, double luminous_flux) {
  Parts::Lamp& lamp = live_.parts.lamps.at(at(light));
  lamp.level = level;
  stage_.light.set_level(lamp.id, level * luminous_flux / lamp.nominal_flux);
  stage_.note_change();
  lights_changed_ = true;
}

void InstanceOutputs::event(const std::string& event, const std::string& detail) {
  events_.push_back({time_, device_.name, device_.kind, event, detail});
  told_ = true;
}

}  // namespace angen::sim
