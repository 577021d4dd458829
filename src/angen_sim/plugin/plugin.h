#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "plugin/params.h"
#include "plugin/reading.h"
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
};

/// Something that looks. The world gives it rays' answers; it gives a reading.
class Sensor {
 public:
  virtual ~Sensor() = default;
  virtual void configure(Params& params, Wiring& wiring) = 0;
  /// How often it looks, ns; 0 = as often as it publishes (<update_rate>, or default_rate()).
  virtual Nanoseconds sample_period() const { return 0; }
  virtual double default_rate() const { return 10.0; }  // Hz
  /// True for one that costs much: it looks only while somebody wants its readings.
  virtual bool on_demand() const { return false; }
  virtual void aim(const View&, RayBatch&) {}                                      // ask
  virtual void read(const View& view, Hits hits, Rng& rng, Reading& reading) = 0;  // answer
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
