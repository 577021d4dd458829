#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/element.h"
#include "core/time.h"
#include "plugin/noise.h"
#include "plugin/range.h"

namespace angen {

/// One parameter as `angen plugins` lists it.
struct ParamDoc {
  std::string path;
  std::string type;
  std::string fallback;  // default, as text
  std::string unit;
  std::string doc;
  std::vector<std::string> choices;  // where it is one of some words
};

/// A plug-in's parameters: children of <plugin>, then of the <sensor> around it. A path such as
/// "ray/range/max" walks down. A wrong type, a value out of range or not finite throws Error with
/// file and line; finish() does so for keys that were not read.
class Params {
 public:
  /// `rate` in Hz is the kind's, for a sensor without an <update_rate>.
  explicit Params(const Element& plugin, const Element* sensor = nullptr, double rate = 1.0);

  double number(const std::string& path, double fallback, const std::string& unit,
                const std::string& doc, Range range = {});
  int integer(const std::string& path, int fallback, const std::string& unit,
              const std::string& doc, Range range = {});
  bool flag(const std::string& path, bool fallback, const std::string& doc);
  std::string text(const std::string& path, const std::string& fallback, const std::string& doc);
  /// One of `choices`.
  std::string choice(const std::string& path, const std::string& fallback,
                     const std::vector<std::string>& choices, const std::string& doc);
  /// Every <path> child of the plug-in as `count` numbers each.
  std::vector<std::vector<double>> rows(const std::string& path, std::size_t count,
                                        const std::string& unit, const std::string& doc);
  /// <path> as so many numbers as `fallback`, which is returned if it is not given.
  std::vector<double> row(const std::string& path, const std::vector<double>& fallback,
                          const std::string& unit, const std::string& doc);
  /// The attribute `name` of every <path> child, "" where one has none.
  std::vector<std::string> names(const std::string& path) const;
  /// The text of every `path`, none when it is not given.
  std::vector<std::string> texts(const std::string& path, const std::string& unit,
                                 const std::string& doc);
  /// <update_rate> (or the plug-in's <updateRate>, as Gazebo's plug-ins also call <updateRateHZ>
  /// and <odometryRate>, where that is not 0) in Hz as a period in ns; 0 or none = the kind's.
  Nanoseconds update_period();
  bool has(const std::string& path) const;
  /// From now on the first of a parameter that is given twice is used, with a warning, as in
  /// Gazebo; otherwise that is an error.
  void take_first() { takes_first_ = true; }

  /// Reads <noise_stddev>, returns it, and gives that field of the sensor's readings such noise.
  double noise(const std::string& field, const std::string& unit, const std::string& doc,
               bool relative = false);
  /// Adds a noise that was read otherwise.
  void noise(Noise noise) { noise_.push_back(std::move(noise)); }
  /// All that noise() was given: the simulator adds it to the sensor's readings.
  const std::vector<Noise>& all_noise() const { return noise_; }

  /// An Error at the place of `path`, or of the plug-in when it is not given there.
  Error error(const std::string& path, const std::string& message) const;

  /// Adds a warning at the place of `path`: its value has less effect than it says.
  void warn(const std::string& path, const std::string& message);
  const std::vector<Diagnostic>& warnings() const { return warnings_; }

  /// Throws for the first key of the plug-in that was not read, naming the known ones. Keys that
  /// any of Gazebo's plug-ins may carry (topicName, alwaysOn, …) are always known.
  void finish() const;
  /// All of these, as warnings.
  std::vector<Diagnostic> unread() const;
  const std::vector<ParamDoc>& docs() const { return docs_; }

 private:
  std::vector<const Element*> all(const std::string& path) const;
  const Element* take(const std::string& path, const std::string& type, const std::string& fallback,
                      const std::string& unit, const std::string& doc);
  void check_range(const std::string& path, const Element& given, double value,
                   const std::string& unit, Range range) const;
  void note(const std::string& path, const std::string& type, const std::string& fallback,
            const std::string& unit, const std::string& doc);
  void list_unread(const Element& parent, const std::string& prefix,
                   std::vector<Diagnostic>& to) const;

  Element plugin_;
  Element sensor_;
  double rate_;
  bool takes_first_ = false;
  std::set<std::string> read_;
  std::vector<ParamDoc> docs_;
  std::vector<Noise> noise_;
  std::vector<Diagnostic> warnings_;
};

/// Reads <sample_rate> (Hz), of a sensor that samples more often than it publishes, as a period.
inline Nanoseconds read_sample_period(Params& params, double fallback = 100.0,
                                      Range rates = {1e-3, 1e6}) {
  return from_seconds(1.0 /
                      params.number("sample_rate", fallback, "Hz", "how often it samples", rates));
}

/// Reads the name that commands use, of each device.
inline std::string read_device_name(Params& params, const std::string& fallback) {
  return params.text("device_name", fallback, "the name that commands use");
}

}  // namespace angen
