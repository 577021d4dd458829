#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/home.h"
#include "core/pose.h"
#include "core/random.h"
#include "core/time.h"
#include "plugin/ahead.h"
#include "plugin/command.h"
#include "plugin/kind.h"
#include "plugin/params.h"
#include "plugin/parts.h"
#include "plugin/ray_geometry.h"
#include "plugin/reading.h"
#include "plugin/saved_params.h"
#include "rays/scene.h"

namespace angen {

class View;     // plugin/view.h
class Wiring;   // plugin/wiring.h
class Outputs;  // plugin/outputs.h

/// Rays that a sensor casts, in the world frame.
using RayBatch = std::vector<rays::Ray>;

/// Answers to a sensor's rays, in their order.
struct Hits {
  const rays::Hit* data = nullptr;
  std::size_t count = 0;

  const rays::Hit& operator[](std::size_t i) const { return data[i]; }
  std::size_t size() const { return count; }
  const rays::Hit* begin() const { return data; }
  const rays::Hit* end() const { return data + count; }
};

struct Verdict {
  bool accepted = true;
  std::string reason;         // why not, and the right form
  std::function<void()> act;  // executes the command; may be empty

  static Verdict accept() { return {}; }
  /// `act` runs once each device that the command is for has accepted it: all execute it, or
  /// none.
  static Verdict accept(std::function<void()> act) { return {true, "", std::move(act)}; }
  static Verdict reject(std::string why) { return {false, std::move(why), {}}; }
};

/// Something that acts: a door, a lamp. One instance a model.
class Device {
 public:
  virtual ~Device() = default;
  virtual void configure(Params& params, Wiring& wiring) = 0;
  /// A command whose verb and number the kind allows; rejects unless overridden.
  virtual Verdict command(const Command& command, const View& view);
  virtual void update(const View& view, Outputs& outputs) = 0;      // before physics, every tick
  virtual void report(const View& view, Reading& state) const = 0;  // its state
  /// Called after update(): the time until which it needs no other update, as long as it gets no
  /// command and its model sleeps. By default it needs one every tick.
  virtual Nanoseconds idle_until(const View&) const { return 0; }
  /// Called before update() or command() after that much time (ns) without updates.
  virtual void skip(Nanoseconds) {}
  /// Whether its ticks may take up to 20 ms while no body is awake but people and joints that are
  /// led (Wiring::leads).
  virtual bool takes_long_steps() const { return false; }
  /// Called after report(): the poses of the limbs that it declared by Wiring::anatomy, in the
  /// frame of their link. As the model has them unless overridden.
  virtual void pose_limbs(std::vector<Pose>&) const {}
  /// Parameters with which a device that starts in this state continues as this one would; the
  /// others stay as they were given. Poses and joint positions are saved with the model.
  virtual void save(SavedParams&) const {}
  /// The positions (m) of an elevator's joint at which it stops, the lowest first.
  virtual std::vector<double> stops() const { return {}; }
};

/// Something that measures. The world answers its rays; it returns a reading. See docs/plugins.md.
class Sensor {
 public:
  static constexpr int kNoRaySet = -1;

  virtual ~Sensor() = default;
  virtual void configure(Params& params, Wiring& wiring) = 0;
  /// Called after configure(): its rays, where it has a grid of them; Kind::rays draws them.
  virtual std::optional<RayGeometry> rays() const { return std::nullopt; }
  /// How often it samples, ns: what configure() has set, unless overridden.
  virtual Nanoseconds sample_period() const { return sample_period_; }
  /// Called before each sample: which of its sets of rays it needs now. For a set that it had
  /// before, at the same pose, aim() is not called and static hits are cached.
  virtual int ray_set(const View&) { return kNoRaySet; }
  virtual void aim(const View&, RayBatch&) {}  // the rays to cast
  /// The reading, without the noise that configure() declared by Params::noise(). `rng` is for
  /// other random effects.
  virtual void read(const View& view, Hits hits, Rng& rng, Reading& reading) = 0;
  /// Called after read(): when a sample may next have other values, an event or be urgent, as
  /// long as its pose and all that it queried stay as they are. Values that differ by the noise of
  /// Params::noise(), or as lazy_reading() has them, are no others.
  virtual Nanoseconds idle_until(const Ahead&) const { return 0; }
  /// Makes its readings until then, without the noise of Params::noise(); null: they are the last.
  virtual std::shared_ptr<const LazyReading> lazy_reading() const { return nullptr; }
  /// Called before the sample after those that its lazy reading replaced, the last of them at
  /// `time`: the sensor's state is to be as if it had read them. `draws` are of that last one.
  virtual void skip(Nanoseconds, const Draws&) {}

 protected:
  /// ns; 0 = as often as it publishes (<update_rate>, or its kind's rate).
  Nanoseconds sample_period_ = 0;
};

/// The description of a model by which a plug-in decides whether to serve it.
struct ModelInfo {
  struct Joint {
    std::string name;
    std::string type;  // fixed, revolute, prismatic, ball, universal
    std::string parent;
    std::string child;
    Vec3 axis = Vec3::Zero();  // its first, in the world at position 0; zero if it has none
    double lower = 0.0;        // rad or m
    double upper = 0.0;
    double height = 0.0;    // m, of its anchor in the world
    bool on_world = false;  // its child can move, its parent is the world or fixed to it
    bool taken = false;     // a device of the model's own plug-ins drives it, or one names it

    bool vertical() const { return std::abs(axis.z()) > 0.999; }
  };
  std::string name;
  Pose pose;
  std::vector<std::string> links;
  std::vector<Joint> joints;
  std::vector<std::string> lights;
  std::vector<Storey> storeys;  // the world's, by elevation; none if it has no walls

  const Joint* joint(const std::string& joint_name) const;
};

/// One of a model's devices: its name in commands, and its joint where a model may have several.
struct Mount {
  std::string name;
  std::string joint;
};

/// An entry of the catalog: a kind, and how to make one. Libraries register it with
/// ANGEN_REGISTER_PLUGIN below; one library may hold several.
class Plugin {
 public:
  virtual ~Plugin() = default;
  virtual const Kind& kind() const = 0;
  /// Devices: does this model get one?
  virtual bool serves(const ModelInfo&) const { return false; }
  /// Devices: the name that commands use.
  virtual std::string instance_name(const ModelInfo& model) const { return model.name; }
  virtual std::unique_ptr<Device> make_device() const { return nullptr; }
  /// Devices: all that this model gets, by the parameters of the <plugin>. One where serves() says
  /// so, unless overridden.
  virtual std::vector<Mount> mounts(const ModelInfo& model, Params& params) const;
  virtual std::unique_ptr<Device> make_device_on(const Mount&) const { return make_device(); }
  /// Devices: the part that a model needs to get one, such as "a light"; errors name it.
  virtual std::string needs() const { return ""; }
  /// Sensors: of the class that these parameters choose, where there are several.
  virtual std::unique_ptr<Sensor> make_sensor(Params&) const { return nullptr; }
  bool makes_sensors() const;
  /// Sensors that a <plugin> of a model makes, as Gazebo's IMU: the link that it sits on by these
  /// parameters, "" = the model's first. None: it is a <sensor>'s plug-in, or switched off.
  virtual std::optional<std::string> link_of(Params&) const { return std::nullopt; }
};

}  // namespace angen
