#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plugin/outputs.h"
#include "plugin/plugin.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

/// A world of plain values, for testing one device or sensor without a simulation.
namespace angen::test {

struct FakeJoint {
  JointView state;
  JointLimits limits{-1e16, 1e16};
  bool fixed = false;
  std::string child = "child";
  Vec3 anchor = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  JointWrench wrench;
  double force = 0.0;  // the device's request in this tick
  double motor_velocity = 0.0;
  double motor_force = 0.0;
  double latch_force = 0.0;  // 0: not latched
};

struct FakeLink {
  LinkView state;
  double mass = 1.0;
  Vec3 center = Vec3::Zero();
  Vec3 drive_velocity = Vec3::Zero();
  double drive_yaw_rate = 0.0;
  double drive_force = 0.0;
};

struct FakeLight {
  double level = 0.0;
  double luminous_flux = 0.0;
};

struct FakeDevice {
  std::string kind;
  std::string name;
  std::string model;
  Pose pose;
  Reading state;
};

/// View, Wiring and Outputs of one instance over the same values. Fill joints, links, lights,
/// collisions before configure(); names not filled in throw Error as the real ones do.
class FakeWorld : public View, public Wiring, public Outputs {
 public:
  using Names = std::vector<std::string>;

  Nanoseconds now = 0;
  Nanoseconds dt = 1'000'000;
  const rays::Scene* scene = nullptr;  // none: rays hit nothing
  mutable int ray_queries = 0;
  Pose at;
  std::string instance = "it";
  std::string model_name = "model";
  Vec3 gravity_vector{0.0, 0.0, -9.81};
  std::vector<std::pair<std::string, FakeJoint>> joints;
  std::vector<std::pair<std::string, FakeLink>> links;
  std::vector<std::pair<std::string, FakeLight>> lights;
  Names collisions;
  Names surface_names;
  double ambient = 295.15;  // K
  Revisions revisions;
  std::map<std::string, std::vector<ContactPair>> touching;           // by collision name
  std::map<std::string, std::vector<ContactPair>> touched;            // lately, and not now
  std::function<light::Sample(light::Probe&, const Pose&)> light_at;  // dark where not given
  std::function<std::vector<std::uint8_t>(const render::PinholeCamera&, const Pose&)> colors_at;
  std::function<std::vector<float>(const render::PinholeCamera&, const Pose&)> depths_at;
  std::vector<FakeDevice> others;
  Home described;
  std::vector<double> floor_heights;  // m, of the storeys from its model up
  struct Push {
    std::string link;
    Vec3 force;
    Vec3 torque;
  };
  std::vector<Push> pushes;
  std::vector<std::string> commands;  // "KIND NAME TEXT", to other devices
  std::vector<std::pair<std::string, std::string>> events;

  FakeJoint& joint_named(const std::string& name) { return joints[index(joints, name)].second; }
  /// The number of its events of that name.
  std::ptrdiff_t count(const std::string& event) const {
    return std::count_if(events.begin(), events.end(),
                         [&](const auto& each) { return each.first == event; });
  }
  /// Forces hold for one tick: call before each Device::update.
  void begin_tick() {
    for (auto& [name, joint] : joints) joint.force = 0.0;
  }

  // View
  Nanoseconds time() const override { return now; }
  Nanoseconds step() const override { return dt; }
  Pose pose() const override { return at; }
  JointView joint(JointRef ref) const override { return joints.at(ref.index).second.state; }
  JointWrench wrench(JointRef ref) const override { return joints.at(ref.index).second.wrench; }
  LinkView link(LinkRef ref) const override { return links.at(ref.index).second.state; }
  std::vector<ContactPair> contacts(ContactRef ref) const override {
    const auto found = touching.find(collisions.at(ref.index));
    return found == touching.end() ? std::vector<ContactPair>{} : found->second;
  }
  std::vector<ContactPair> contacts_within(ContactRef ref, Nanoseconds) const override {
    std::vector<ContactPair> all = contacts(ref);
    const auto found = touched.find(collisions.at(ref.index));
    if (found != touched.end()) all.insert(all.end(), found->second.begin(), found->second.end());
    return all;
  }
  using View::devices;
  std::vector<DeviceView> devices(const std::string& field,
                                  const Eigen::AlignedBox3d& within) const override {
    std::vector<DeviceView> found;
    for (const FakeDevice& d : others) {
      if (d.state.find(field) == nullptr || !within.contains(d.pose.position)) continue;
      found.push_back({d.kind, d.name, d.model, d.pose, d.state});
    }
    return found;
  }
  std::optional<DeviceView> device(const std::string& field, const std::string& kind,
                                   const std::string& device_name) const override {
    for (const DeviceView& each : devices(field)) {
      if (each.kind == kind && each.name == device_name) return each;
    }
    return std::nullopt;
  }
  bool has_device(const std::string& field, const std::string& kind,
                  const std::string& device_name) const override {
    return device(field, kind, device_name).has_value();
  }
  const Home& home() const override { return described; }
  const rays::Scene& rays() const override {
    static const rays::Scene nothing;
    ++ray_queries;
    return scene == nullptr ? nothing : *scene;
  }
  std::vector<std::uint32_t> own_shapes() const override { return {}; }
  light::Sample illuminance(light::Probe& probe, const Pose& pose) const override {
    return light_at ? light_at(probe, pose) : light::Sample{};
  }

  double ambient_temperature() const override { return ambient; }
  const std::vector<rays::WarmShape>& warm_shapes() const override {
    static const std::vector<rays::WarmShape> none;
    return scene == nullptr ? none : scene->warm_shapes();
  }
  Revisions watch(const std::function<std::vector<rays::Ray>()>&) const override {
    return revisions;
  }
  std::vector<std::uint8_t> colors(const render::PinholeCamera& lens,
                                   const Pose& pose) const override {
    return colors_at ? colors_at(lens, pose) : std::vector<std::uint8_t>{};
  }
  std::vector<float> depths(const render::PinholeCamera& lens, const Pose& pose) const override {
    return depths_at ? depths_at(lens, pose) : std::vector<float>{};
  }

  // Wiring
  std::string name() const override { return instance; }
  std::string model() const override { return model_name; }
  std::vector<Room> rooms() const override { return described.rooms; }
  std::vector<double> floors() const override { return floor_heights; }
  Vec3 gravity() const override { return gravity_vector; }
  bool has_joint(const std::string& joint) const override {
    for (const auto& [name, value] : joints) {
      if (name == joint) return true;
    }
    return false;
  }
  Names joint_names() const override {
    Names names;
    for (const auto& [name, value] : joints) names.push_back(name);
    return names;
  }
  JointRef joint(const std::string& joint) override { return {index(joints, joint)}; }
  JointLimits limits(JointRef ref) const override { return joints.at(ref.index).second.limits; }
  LinkRef link(const std::string& link) override {
    const bool named = std::any_of(links.begin(), links.end(),
                                   [&](const auto& each) { return each.first == link; });
    if (link.empty() && !named) return {links.empty() ? -1 : 0};  // its own, as the real ones do
    return {index(links, link)};
  }
  bool is_fixed(JointRef ref) const override { return joints.at(ref.index).second.fixed; }
  std::string child_of(JointRef ref) const override { return joints.at(ref.index).second.child; }
  Vec3 anchor(JointRef ref) const override { return joints.at(ref.index).second.anchor; }
  Vec3 axis(JointRef ref) const override { return joints.at(ref.index).second.axis; }
  double mass(LinkRef ref) const override { return links.at(ref.index).second.mass; }
  Vec3 center(LinkRef ref) const override { return links.at(ref.index).second.center; }
  LightRef light(const std::string& light) override {
    if (light.empty() && lights.size() == 1) return {0};
    return {index(lights, light)};
  }
  Names collision_names(LinkRef) const override { return collisions; }
  ContactRef collision(LinkRef, const std::string& collision) override {
    for (std::size_t i = 0; i < collisions.size(); ++i) {
      if (collisions[i] == collision) return {static_cast<int>(i)};
    }
    throw Error("no collision " + collision + "; known are " + join_names(collisions));
  }
  std::optional<SensorPart> sensor(const std::string&) override { return std::nullopt; }
  std::vector<SurfaceRef> surfaces(const std::string& visual) override {
    std::vector<SurfaceRef> found;
    for (std::size_t i = 0; i < surface_names.size(); ++i) {
      if (visual.empty() || surface_names[i] == visual) found.push_back({static_cast<int>(i)});
    }
    return found;
  }

  // Outputs
  void force(JointRef ref, double force) override { joints.at(ref.index).second.force += force; }
  void motor(JointRef ref, double velocity, double max_force) override {
    joints.at(ref.index).second.motor_velocity = velocity;
    joints.at(ref.index).second.motor_force = max_force;
  }
  void latch(JointRef ref, double break_force) override {
    joints.at(ref.index).second.latch_force = break_force;
  }
  void unlatch(JointRef ref) override { joints.at(ref.index).second.latch_force = 0.0; }
  void drive(LinkRef ref, const Vec3& velocity, double yaw_rate, double max_force) override {
    FakeLink& link = links.at(ref.index).second;
    link.drive_velocity = velocity;
    link.drive_yaw_rate = yaw_rate;
    link.drive_force = max_force;
  }
  void push(LinkRef ref, const Vec3& force, const Vec3& torque, const Vec3&) override {
    pushes.push_back({links.at(ref.index).first, force, torque});
  }
  void light(LightRef ref, double level, double luminous_flux) override {
    lights.at(ref.index).second = {level, luminous_flux};
  }
  void temperature(SurfaceRef, double, double, double) override {}
  void command(const std::string& kind, const std::string& name, const std::string& text) override {
    commands.push_back(kind + " " + name + " " + text);
  }
  void event(const std::string& event, const std::string& detail) override {
    events.emplace_back(event, detail);
  }

 protected:
  template <class T>
  static int index(const std::vector<std::pair<std::string, T>>& all, const std::string& name) {
    Names known;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].first == name) return static_cast<int>(i);
      known.push_back(all[i].first);
    }
    throw Error("no " + name + "; known are " + join_names(known));
  }
};

/// <name>text</name>, for building a plug-in's element in a test.
inline Element element(std::string name, std::string text = "",
                       std::vector<Element> children = {}) {
  Element made;
  made.name = std::move(name);
  made.text = std::move(text);
  made.children = std::move(children);
  made.source = {"test.sdf", 1};
  return made;
}

/// <plugin> with one child for each pair.
inline Element plugin_element(const std::vector<std::pair<std::string, std::string>>& parameters) {
  Element made = element("plugin");
  for (const auto& [key, value] : parameters) made.children.push_back(element(key, value));
  return made;
}

}  // namespace angen::test
