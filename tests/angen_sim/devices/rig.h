#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "angen_sim/fakes.h"
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

  /// Makes rays hit a model.
  void show(const desc::Model& model, physics::ModelId id);
  const rays::Scene& rays();

  void tick();
  /// Ticks for that many seconds; `each` is called after every tick.
  void run(
      double seconds, const std::function<void()>& each = [] {});
  /// Ticks until `done`, at most that many seconds; the seconds it took, or -1.
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
  void move_shapes();

  rays::Scene rays_;
  std::vector<Shown> shown_;
  Catalog catalog_;
  std::vector<std::unique_ptr<Rig>> rigs_;
};

/// The view and the outputs of one device, on one model of the bench: physics moves it.
class Rig : public FakeWorld {
 public:
  Rig(Bench& bench, const desc::Model& model, std::shared_ptr<const Plugin> plugin,
      const Parameters& parameters);

  Verdict command(const std::string& text) { return command(Command{text, {}, "", 0.0}); }
  Verdict command(double v, double w) { return command(Command{"", {v, w}, "", 0.0}); }
  void update() { device_->update(*this, *this); }
  Reading state() const;
  std::string mode() const { return state().get<std::string>("mode"); }
  JointView at(const std::string& name) const { return joint(JointRef{index(joints, name)}); }
  LinkView body(const std::string& name) const { return link(LinkRef{index(links, name)}); }
  physics::ModelId id() const { return model_id_; }

  std::vector<Diagnostic> warnings;  // of its parameters
  int forces = 0;                    // how often the device has added a force that is not 0
  int calls = 0;                     // how often it has done anything to the world

  using FakeWorld::joint;
  using FakeWorld::link;
  Nanoseconds time() const override { return bench_.now(); }
  JointView joint(JointRef joint) const override;
  JointWrench wrench(JointRef joint) const override;
  LinkView link(LinkRef link) const override;
  const rays::Scene& rays() const override { return bench_.rays(); }
  void force(JointRef joint, double force) override;
  void motor(JointRef joint, double velocity, double max_force) override;
  void latch(JointRef joint, double break_force) override;
  void unlatch(JointRef joint) override;
  void drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) override;
  void push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) override;

 private:
  void describe(const desc::Model& model);
  Verdict command(Command command);
  physics::JointId id_of(JointRef joint) const;
  physics::LinkId id_of(LinkRef link) const;

  Bench& bench_;
  physics::ModelId model_id_;
  std::shared_ptr<const Plugin> plugin_;
  std::unique_ptr<Device> device_;
};

}  // namespace angen::test
