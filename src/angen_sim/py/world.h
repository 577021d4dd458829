#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "py/convert.h"
#include "py/exclusive.h"
#include "py/interrupts.h"
#include "py/reading_log.h"
#include "record/fingerprint.h"
#include "record/recorder.h"
#include "record/replay.h"
#include "record/world_file.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::py {

/// Converts seconds from Python; Error if they are negative, not finite, or beyond the limit.
Nanoseconds duration(double seconds);

/// A simulation as Python sees it: loads, steps, commands, reads.
class World : public Exclusive {
 public:
  /// `log` names a file to record into, unless it is empty. With `allow_paths` documents may name
  /// files anywhere; the catalog knows which libraries.
  World(const std::string& path, std::uint64_t seed, std::shared_ptr<Catalog> catalog,
        const std::string& log, bool allow_paths);
  World(const std::string& text, const std::string& name, std::uint64_t seed,
        std::shared_ptr<Catalog> catalog, bool allow_paths);

  /// A view of one that others advance, see follow(): closed from the start.
  explicit World(sim::Simulation& simulation)
      : simulation_(simulation), snapshot_(simulation.snapshot()), closed_(true) {}

  /// Continues a simulation that has run already, of a world whose models are found in `models`.
  World(std::unique_ptr<sim::Simulation> simulation, const std::string& models);

  /// Takes each tick. Returns whether it has ended before `ticks`, as Ctrl-C came.
  bool step(std::uint64_t ticks, const Interrupts& interrupts);
  /// Runs ticks, leaping over those without a change; for `long_steps` see Simulation::leap.
  /// Returns whether it has ended before `ticks`, with an event or as Ctrl-C came.
  bool run(std::uint64_t ticks, bool long_steps, bool until_event, const Interrupts& interrupts);
  std::uint64_t ticks_in(double seconds) const;

  /// Throw Error if the simulator rejects the action.
  void command(const std::string& kind, const std::string& name, const std::string& text,
               const std::vector<double>& values);
  void spawn(const std::string& what, const std::string& name, const std::vector<double>& pose,
             const std::string& on);
  void remove(const std::string& name);
  void edit(sim::Edit edit);
  /// The present motion of a model, link or collision.
  sim::Motion motion(const std::string& entity) const;
  std::vector<rays::Hit> cast(const std::vector<rays::Ray>& rays) const {
    return simulation_.cast(rays);
  }
  void request(const std::string& kind, const std::string& name, bool wanted);
  void reset();
  /// The simulation of a view has advanced.
  void follow(std::shared_ptr<const sim::Snapshot> snapshot) { take(std::move(snapshot)); }
  /// Completes the record. From now on the world is only read.
  void close();

  Reading sensor(const std::string& kind, const std::string& name) const;
  Reading device(const std::string& kind, const std::string& name) const;
  /// The summary of a sensor or device, as on /angen/summary; "" before its first reading.
  std::string summary(const std::string& kind, const std::string& name) const;
  /// A sensor or device in a few words.
  struct Brief {
    std::string kind, name, text;
    bool alarm = false;
    double stamp = 0.0;             // s
    std::vector<double> numbers{};  // see angen::numbers()
  };
  /// Each sensor and device.
  std::vector<Brief> summaries() const;
  std::string save();

  const sim::Snapshot& now() const { return *snapshot_; }
  std::vector<sim::Event> take_events();
  /// Keeps the readings of all sensors from now on.
  void keep_readings() { readings_.emplace(); }
  /// The kept readings; throws Error if keep_readings() was not called.
  ReadingLog& readings();
  /// Warnings of all loaded files, as "file:line: text".
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Elements of those files that are not read, as "file:line: what".
  const std::vector<std::string>& ignored() const { return ignored_; }
  /// Its name, time and counts in one line.
  std::string text() const;
  std::string fingerprint() const { return fingerprint_.text(); }

 private:
  void begin();
  /// Takes ticks by advance(END), until there are none, Ctrl-C came or, with `until_event`, one has
  /// an event.
  template <class Advance>
  bool advance(std::uint64_t ticks, bool until_event, const Interrupts& interrupts,
               Advance&& advance);
  Brief brief_sensor(std::size_t index) const;
  Brief brief_device(std::size_t index) const;
  void require_open() const;
  Nanoseconds leap_limit(Nanoseconds until) const;
  static void note(const std::vector<Diagnostic>& found, std::vector<std::string>& to);
  static void note(std::string text, std::vector<std::string>& to);
  void note_warnings(const sim::Snapshot& snapshot);
  /// Executes an action, as the only call in progress.
  void drain(sim::Action action);
  void execute(sim::Action action);
  /// Error if a plug-in has thrown since; the world has continued without it.
  void raise_failure();
  void take(std::shared_ptr<const sim::Snapshot> snapshot);

  load::SearchPaths paths_;
  std::unique_ptr<sim::Simulation> owned_;
  sim::Simulation& simulation_;
  std::unique_ptr<record::Recorder> recorder_;
  std::shared_ptr<const sim::Snapshot> snapshot_;
  std::vector<sim::Event> events_;
  std::optional<ReadingLog> readings_;
  std::vector<std::string> warnings_;
  std::vector<std::string> ignored_;
  bool closed_ = false;
  std::string failure_;  // a plug-in's, until it is raised
  record::Fingerprint fingerprint_;
};

}  // namespace angen::py
