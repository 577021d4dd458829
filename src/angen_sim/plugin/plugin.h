#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "plugin/params.h"
#include "plugin/reading.h"
#include "plugin/saved_params.h"
#include "plugin/view.h"

namespace angen {

/// What followed the target's name: "Open", "Dim 40", or numbers (a drive: m/s, rad/s).
struct Command {
  std::string text;
  std::vector<double> values;
};

struct Verdict {
  bool accepted = true;
  std::string reason;         // why not, what would be right
  std::function<void()> act;  // what obeying is; may be empty

  static Verdict accept() { return {}; }
  /// `act` is done once each device that the command is for has accepted it: all obey, or none.
  static Verdict accept(std::function<void()> act) { return {true, "", std::move(act)}; }
  static Verdict reject(std::string why) { return {false, std::move(why), {}}; }
};

/// Something that acts: a door, a lamp. One instance a model.
class Device {
 public:
  virtual ~Device() = default;
  virtual void configure(Params& params, Wiring& wiring) = 0;
  virtual Verdict command(const Command& command, const View& view);  // rejects unless overridden
  virtual void update(const View& view, Outputs& outputs) = 0;        // before physics, every tick
  virtual void report(const View& view, Reading& state) const = 0;    // what is published on change
  /// Asked after update(): the time up to which it needs no other, as long as it gets no command
  /// and its model sleeps. By default it needs one every tick.
  virtual Nanoseconds idle_until(const View&) const { return 0; }
  /// Told before update() or command() that so much time (ns) went by without updates.
  virtual void skip(Nanoseconds) {}
  /// Parameters with which a device that starts where this one is goes on as this one would; the
  /// others stay as they were given. Poses and joint positions are saved with the model.
  virtual void save(SavedParams&) const {}
};
constexpr Nanoseconds kForever = INT64_MAX;

/// How a sensor's readings go on while its pose and all that it asked of the world (its rays' hits,
/// illuminance, contacts, …) stay as they are.
enum class Rest {
  kBusy,   // nothing is known: it looks each time
  kSame,   // with the last one's values, no event, not urgent: it is not asked for them again
  kNoise,  // they vary as its echo() says, tell no event and are not urgent, save at few looks: see
           // quiet_chance()
};

/// The random numbers of a look, (0), and of those before it: (1) of the last one before.
using Draws = std::function<Rng(int looks_ago)>;

/// What a sensor at Rest::kNoise would read. Snapshots have it in place of readings that nobody has
/// looked at: any thread asks it, also when its sensor has gone, so it depends on neither.
class Echo {
 public:
  virtual ~Echo() = default;
  /// Fills in the values of the look at `time`, as the sensor's read() would.
  virtual void read(Nanoseconds time, const Draws& draws, Reading& reading) const = 0;
};

/// Something that looks. The world gives it rays' answers; it gives a reading.
class Sensor {
 public:
  static constexpr int kNoStance = -1;

  virtual ~Sensor() = default;
  virtual void configure(Params& params, Wiring& wiring) = 0;
  /// How often it looks, ns; 0 = as often as it publishes (<update_rate>, or default_rate()).
  virtual Nanoseconds sample_period() const { return 0; }
  virtual double default_rate() const { return 10.0; }  // Hz
  /// True for one that costs much: it looks only while somebody wants its readings.
  virtual bool on_demand() const { return false; }
  /// Asked before each look, with the time in `view`: which of its sets of rays it needs. For one
  /// that it had before, at the same pose, aim() is not called: it would ask for the same rays.
  virtual int stance(const View&) { return kNoStance; }
  virtual void aim(const View&, RayBatch&) {}                                      // ask
  virtual void read(const View& view, Hits hits, Rng& rng, Reading& reading) = 0;  // answer
  /// Asked after each read().
  virtual Rest rest() const { return Rest::kBusy; }
  /// Of one at Rest::kNoise: a look may tell an event or be urgent only where the first uniform()
  /// of its random numbers is not below this.
  virtual double quiet_chance() const { return 0.0; }
  /// How many looks back a reading at Rest::kNoise depends on.
  virtual int memory() const { return 0; }
  /// Of one at Rest::kNoise: what stands for it while nothing changes, instead of readings.
  virtual std::shared_ptr<const Echo> echo() const { return nullptr; }
  /// Told before the look that follows after its echo stood for it, the last time at `time`: it is
  /// to be as if it had read what the echo did. `draws` are of that look.
  virtual void resume(Nanoseconds /*time*/, const Draws& /*draws*/) {}
};

/// What a plug-in sees of a model before deciding to serve it.
struct ModelInfo {
  struct Joint {
    std::string name;
    std::string type;  // fixed, revolute, prismatic, ball, universal
    std::string parent;
    std::string child;
  };
  std::string name;
  Pose pose;
  std::vector<std::string> links;
  std::vector<Joint> joints;
  std::vector<std::string> lights;

  const Joint* joint(const std::string& joint_name) const;
};

/// An entry of the catalog: a kind, and how to make one. Libraries register it with
/// ANGEN_REGISTER_PLUGIN below; one library may hold several.
class Plugin {
 public:
  virtual ~Plugin() = default;
  virtual std::string kind() const = 0;  // "door"
  virtual std::string doc() const = 0;   // one line
  /// Devices: does this model get one?
  virtual bool serves(const ModelInfo&) const { return false; }
  /// Devices: the name that commands use.
  virtual std::string instance_name(const ModelInfo& model) const { return model.name; }
  virtual std::unique_ptr<Device> make_device() const { return nullptr; }
  virtual std::unique_ptr<Sensor> make_sensor() const { return nullptr; }
};

}  // namespace angen
