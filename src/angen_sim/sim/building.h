#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/building_home.h"
#include "sim/devices_by_field.h"
#include "sim/faults.h"
#include "sim/instance.h"
#include "sim/pushes.h"
#include "sim/registry.h"
#include "sim/saved.h"

namespace angen::sim {

/// All models with their devices and sensors, in the engines that they share.
class Building {
 public:
  Building(const desc::World& world, std::uint64_t seed, std::shared_ptr<Catalog> catalog);

  /// Puts a model into the world at `now`, or throws Error and changes nothing.
  void add(desc::Model model, Nanoseconds now);
  /// Puts a sensor on `link` (model::link), or throws Error and changes nothing.
  void attach(const desc::Sensor& sensor, const std::string& link, Nanoseconds now);
  /// Moves a sensor on its link, `by` in its own frame.
  void displace(const std::string& kind, const std::string& name, const Pose& by);
  /// Removes the model or attached sensor called `name`, or throws Error.
  void erase(const std::string& name);
  /// Everything that is there back to where and how it was when it was added.
  void reset(Nanoseconds now);

  Engines& engines() { return *engines_; }
  const Engines& engines() const { return *engines_; }
  std::vector<std::unique_ptr<LiveModel>>& models() { return models_; }
  const std::vector<std::unique_ptr<LiveModel>>& models() const { return models_; }

  /// The model that a body's link belongs to, and the link's number in it.
  struct Owner {
    LiveModel* model = nullptr;
    std::uint32_t link = 0;
  };
  Owner owner(physics::LinkId link) const { return owners_[link.index]; }

  /// The pose of a model's frame.
  Pose pose_of(const LiveModel& live) const;

  /// The devices whose last state has a field of that name and that are in `within`, or whose
  /// models are, in the order of the models.
  std::vector<const FoundDevice*> find_devices(const std::string& field,
                                               const Eigen::AlignedBox3d& within) const;
  /// The device of that kind and name, if its last state has that field.
  std::optional<FoundDevice> find_device(const std::string& field, const std::string& kind,
                                         const std::string& name) const;
  /// To be called when a device of a model at `pose` reports another state.
  void note_state(const LiveModel& live, DeviceInstance& device, const Pose& pose,
                  MoverIndex::Moment when) const;
  /// To be called when a model has moved: its devices have.
  void note_states(LiveModel& live, MoverIndex::Moment when) const;
  /// To be called when a device has other fields than before.
  void forget_fields() {
    by_field_.clear();
    engines_->states.note_all(engines_->movers.now());
  }

  struct Target {
    LiveModel* live;
    DeviceInstance* device;
  };
  /// The devices of that kind (any where it is empty) and name, in the order of the models; all of
  /// the kind for the name "all".
  std::vector<Target> devices_named(const std::string& kind, const std::string& name) const;
  /// The names of a kind's devices; of all devices as KIND/NAME where it is empty.
  std::vector<std::string> device_names(const std::string& kind) const;

  /// Null if there is none.
  LiveModel* find(const std::string& model) const { return registry_.model(model); }
  std::vector<std::string> model_names() const;

  Pushes& pushes() { return pushes_; }
  Faults& faults() { return faults_; }

  /// The model was put elsewhere between ticks.
  void note_placed(LiveModel& live);
  /// Takes these models out, in the order in which they came into the world.
  std::vector<LiveModel*> take_placed();

  /// Finds the models that are awake after tick number `tick`, each once. They count as changed up
  /// to the tick in which they fall asleep.
  const std::vector<LiveModel*>& note_awake(std::int64_t tick);
  /// To be called when a model has moved.
  void note_moved(LiveModel& live) const { note_moved(live, engines_->movers.now()); }

  /// Inertials, gravity of links and axes of joints from now on. Throws Error and changes nothing.
  void redescribe(LiveModel& live, desc::Model described);

  /// Devices and sensors are configured with it when they are made, also by reset().
  void set_physics(const desc::Physics& physics, const Vec3& gravity);
  const Vec3& gravity() const { return gravity_; }  // m/s^2

  /// The light of that name in Structure::lights, its pose in the world. Throws Error for
  /// names that are unknown, or taken.
  desc::Light light(const std::string& name) const;
  void set_light(const std::string& name, desc::Light light);
  void add_light(const desc::Light& light, const std::string& sdf, Nanoseconds now);
  void erase_light(const std::string& name);

  /// All that may have devices: the models, and then the world's lights.
  std::vector<LiveModel*> with_devices() const;

  /// Grows with every change of the structure.
  std::uint64_t revision() const { return revision_; }
  /// A new Structure; also numbers every model's parts in it. It shares the models that kept their
  /// numbers with the last one: those before the first that was renumbered, and their parts.
  std::shared_ptr<const Structure> structure();
  /// The first model whose number, or whose parts' numbers, structure() will change.
  std::size_t renumbered_from() const { return renumbered_from_; }
  /// The home of the last structure().
  const Home& home() const { return structure_->home->get(); }
  /// The numbers in Structure at which that model's parts begin.
  Numbering numbering(std::size_t model) const;
  /// Levels (0..1) in the order of Structure::lights.
  std::vector<double> light_levels() const;

  /// The plug-ins of devices that differ from how they started, as of `now`.
  std::vector<SavedPlugin> saved_plugins(Nanoseconds now, Nanoseconds step);

  /// The world's lights that were spawned, and all whose own lamps differ from how they started.
  std::vector<SavedLight> saved_lights() const;

  /// The models that differ from how they were read.
  std::vector<ChangedModel> changed_models() const;

  /// Warnings of the last add or of construction.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Returns and clears those warnings.
  std::vector<std::string> take_warnings();

 private:
  struct WorldLight {
    std::unique_ptr<LiveModel> live;  // an instance for it, with its lamp
    std::string sdf;  // the text that it was spawned from, "" for one of the world's text

    const desc::Light& light() const { return live->desc->links[0].lights[0]; }
  };

  WorldLight world_light(const desc::Light& light, const std::string& sdf) const;
  void put_light(WorldLight& own);
  void make_lamp(LiveModel& light, Nanoseconds now);
  void drop_taken_lamps(LiveModel& live);
  void build(desc::Model model, const std::vector<SensorInstance>* attached, Nanoseconds now);
  void start(SensorInstance& sensor, Nanoseconds now) const;
  std::vector<std::shared_ptr<const Plugin>> device_plugins();
  void append(LiveModel& live, Structure& all) const;
  std::size_t number_of(const LiveModel& live) const;
  void make_engines();
  std::vector<std::string> names_to_delete() const;
  void note_change(std::size_t first_model);
  void note_moved(LiveModel& live, MoverIndex::Moment when) const;

  struct FoundLight {
    LiveModel* live = nullptr;   // a light of the world's own, or a model
    std::size_t own = SIZE_MAX;  // in lights_
    std::uint32_t link = 0;
    std::size_t in_link = 0;
    std::size_t lamp = 0;  // in its parts
  };
  FoundLight find_light(const std::string& name) const;

  const desc::World& world_;
  desc::Physics physics_;
  Vec3 gravity_;
  std::uint64_t seed_;
  std::shared_ptr<Catalog> catalog_;
  std::unique_ptr<Engines> engines_;
  std::vector<std::unique_ptr<LiveModel>> models_;
  Registry registry_;
  std::vector<WorldLight> lights_;
  Pushes pushes_;
  Faults faults_;
  std::vector<LiveModel*> placed_;
  std::vector<physics::LinkId> awake_links_;
  std::vector<LiveModel*> awake_;
  std::vector<Owner> owners_;          // by index of physics::LinkId
  std::vector<desc::Plugin> plugins_;  // the world's, but those that are ignored
  std::vector<std::string> warnings_;
  std::uint64_t revision_ = 0;
  std::shared_ptr<const Structure> structure_;  // the last one
  std::size_t renumbered_from_ = 0;
  BuildingHome home_;
  mutable DevicesByField by_field_;
};

}  // namespace angen::sim
