#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "physics/world.h"
#include "plugin/library.h"

/// Devices on bodies moved by physics, without a simulation around them.
namespace angen::test {

using Parameters = std::vector<std::pair<std::string, std::string>>;

class Rig;

/// A world of bodies, and devices on some of them.
class Bench {
 public:
  explicit Bench(const desc::Physics& settings = {});
  ~Bench();

  /// A model without a device.
  physics::ModelId add(const desc::Model& model);
  /// A model and the device of `kind` out of `library`.
  Rig& add(const desc::Model& model, const std::string& library, const std::string& kind,
           const Parameters& parameters = {});

  /// Makes rays meet a model.
  void show(const desc::Model& model, physics::ModelId id);
  void cast(const std::vector<rays::Ray>& rays, std::vector<rays::Hit>& hits);

  void tick();
  /// Ticks for so many seconds; `each` is called after every tick.
  void run(
      double seconds, const std::function<void()>& each = [] {});
  /// Ticks until `done`, at most so many seconds; the seconds it took, or -1.
  double run_until(double seconds, const std::function<bool()>& done);

  Nanoseconds now() const { return tick_ * settings_.step; }
  Nanoseconds step() const { return settings_.step; }
  const Vec3& gravity() const { return gravity_; }
  /// N on collisions whose names start with `one`, from those whose names start with `other`.
  Vec3 contact_force(const std::string& one, const std::string& other) const;

 private:
  desc::Physics settings_;
  Vec3 gravity_{0.0, 0.0, -9.81};
  std::int64_t tick_ = 0;

 public:
  physics::World world;

 private:
  struct Shown {
    physics::LinkId link;
    Pose in_link;
    rays::ShapeId shape;
  };
  rays::Scene rays_;
  std::vector<Shown> shown_;
  Catalog catalog_;
  std::vector<std::unique_ptr<Rig>> rigs_;
};

/// What one device sees, and what it does, on one model of the bench.
class Rig : public View, public Wiring, public Outputs {
 public:
  Rig(Bench& bench, desc::Model model, std::shared_ptr<const Plugin> plugin,
      const Parameters& parameters);

  Verdict command(const std::string& text) { return command(Command{text, {}, "", 0.0}); }
  Verdict command(double v, double w) { return command(Command{"", {v, w}, "", 0.0}); }
  void update() { device_->update(*this, *this); }
  Reading state() const;
  std::string mode() const { return state().get<std::string>("mode"); }
  JointView at(const std::string& joint) const;
  LinkView body(const std::string& link) const;
  physics::ModelId id() const { return model_id_; }

  std::vector<std::string> events;
  std::vector<Diagnostic> warnings;  // of its parameters
  int forces = 0;                    // how often the device has added a force that is not 0
  int calls = 0;                     // how often it has done anything to the world

  // View
  Nanoseconds time() const override { return bench_.now(); }
  Nanoseconds step() const override { return bench_.step(); }
  Pose pose() const override { return model_.pose; }
  JointView joint(JointRef joint) const override;
  JointWrench wrench(JointRef joint) const override;
  LinkView link(LinkRef link) const override;
  std::vector<ContactPair> contacts(ContactRef) const override { return {}; }
  std::vector<ContactPair> contacts_within(ContactRef, Nanoseconds) const override { return {}; }
  std::vector<DeviceView> devices(const std::string&, const Eigen::AlignedBox3d&) const override {
    return {};
  }
  void cast(const std::vector<rays::Ray>& rays, std::vector<rays::Hit>& hits) const override;
  Eigen::Vector3f reflectance(std::uint32_t) const override { return Eigen::Vector3f::Zero(); }
  light::Sample illuminance(light::Probe&, const Pose&) const override { return {}; }
  void expect_light(light::Probe&, const Pose&) const override {}
  double ambient_temperature() const override { return 295.15; }
  const std::vector<rays::WarmShape>& warm_shapes() const override { return warm_; }
  std::uint64_t scene_revision() const override { return 0; }
  std::uint64_t surface_revision() const override { return 0; }
  std::vector<rays::Crossing> crossings(const Vec3&, const Vec3&) const override { return {}; }
  std::vector<std::uint8_t> colors(const render::PinholeCamera&, const Pose&) const override {
    return {};
  }
  std::vector<float> depths(const render::PinholeCamera&, const Pose&) const override { return {}; }

  // Wiring
  std::string name() const override { return model_.name; }
  std::string model() const override { return model_.name; }
  Vec3 gravity() const override { return bench_.gravity(); }
  bool has_joint(const std::string& joint) const override;
  std::vector<std::string> joint_names() const override;
  JointRef joint(const std::string& joint) override;
  JointLimits limits(JointRef joint) const override;
  LinkRef link(const std::string& link) override;
  bool is_fixed(JointRef joint) const override;
  std::string child_of(JointRef joint) const override;
  Vec3 anchor(JointRef joint) const override;
  double mass(LinkRef link) const override;
  Vec3 center(LinkRef link) const override;
  LightRef light(const std::string& light) override;
  std::vector<std::string> collision_names() const override { return {}; }
  ContactRef collision(const std::string& collision) override;
  std::vector<SurfaceRef> surfaces(const std::string&) override { return {}; }

  // Outputs
  void force(JointRef joint, double force) override;
  void motor(JointRef joint, double velocity, double max_force) override;
  void latch(JointRef joint, double break_force) override;
  void unlatch(JointRef joint) override;
  void drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) override;
  void push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) override;
  void light(LightRef, double, double) override {}
  void temperature(SurfaceRef, double, double, double) override {}
  void event(const std::string& event, const std::string&) override { events.push_back(event); }

 private:
  Verdict command(Command command);
  int joint_index(const std::string& joint) const;
  int link_index(const std::string& link) const;
  physics::JointId id_of(JointRef joint) const;
  physics::LinkId id_of(LinkRef link) const;

  Bench& bench_;
  std::vector<rays::WarmShape> warm_;
  desc::Model model_;
  physics::ModelId model_id_;
  std::shared_ptr<const Plugin> plugin_;
  std::unique_ptr<Device> device_;
};

}  // namespace angen::test
