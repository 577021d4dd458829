#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "plugin/library.h"
#include "sim/command.h"
#include "sim/meter.h"
#include "sim/requested_sensors.h"
#include "sim/saved.h"
#include "sim/snapshot.h"

namespace angen::sim {

/// A world that runs. One thread calls tick(); any thread may post().
class Simulation {
 public:
  /// Builds the world; throws Error if that is impossible (an unknown plug-in, a wrong
  /// parameter).
  Simulation(desc::World world, std::uint64_t seed, std::shared_ptr<Catalog> catalog);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Queues an action for the next tick. The future is answered there (a Step's when it is done).
  /// With a ticket it can be withdrawn.
  std::future<Outcome> post(Action action, std::shared_ptr<Ticket> ticket = nullptr);

  /// Commands, devices, physics, sensors, snapshot; while paused commands and snapshot only.
  /// Returns the snapshot it made.
  std::shared_ptr<const Snapshot> tick();

  /// Like tick(), but first skips the ticks without a change: no body is awake, no command
  /// waits, and devices and sensors would only publish their last readings again, or the
  /// same but for noise. The snapshot is bit for bit that after as many calls of tick().
  /// Its tick ends at `until` at the latest, unless that has passed.
  std::shared_ptr<const Snapshot> leap(Nanoseconds until) { return leap(until, false); }
  /// With `long_steps` ticks are up to 20 ms long while no other bodies are awake than people who
  /// touch nothing but the floor, leaves of doors that touch nothing, and those that came to rest:
  /// people walk some millimeters from where they would be.
  std::shared_ptr<const Snapshot> leap(Nanoseconds until, bool long_steps);

  /// To be called after ticks that follow a clock: spare CPU time is used to find light sooner. No
  /// result depends on it. The thread that ticks.
  void look_ahead();

  /// The latest snapshot; never null.
  std::shared_ptr<const Snapshot> snapshot() const;

  /// Requests this sensor's readings, or ends that; matters to those that sample on demand
  /// only. The sensor need not exist yet. Any thread.
  void request(const std::string& kind, const std::string& name, bool requested);
  bool requested(const std::string& kind, const std::string& name) const;

  /// `actions` sees each action before it is executed, `requests` each call of request().
  /// Both may be null. The thread that ticks.
  void observe(ActionObserver actions, RequestedSensors::Observer requests);

  /// From now on only actions of replay() are executed, and a Save; actions that others post are
  /// rejected with this reason. The thread that ticks, as all of these.
  void accept_only_replay(std::string reason);
  void end_replay();
  /// To be executed in the next tick, after an accept_only_replay().
  void replay(std::vector<Action> actions);

  /// The motion of a link now, by its number in Structure::links of the latest snapshot. The
  /// thread that ticks; others post an Observe.
  Motion motion(std::uint32_t link) const;
  /// Like an Observe; throws Error for names that do not exist. Only the thread that ticks may call
  /// it.
  Observed observe(const Observation& what) const;

  /// The nearest hits on the shapes as they are now: one for each ray. The thread that ticks.
  std::vector<rays::Hit> cast(const std::vector<rays::Ray>& rays) const;

  /// Whether ticks are to measure their cost, from the next one on. No result depends on it.
  /// The thread that ticks.
  void measure(bool on);
  /// The cost of the ticks that were measured since the last call. The thread that ticks.
  Cost take_cost();

  /// The state for a world file, now. The thread that ticks; others post a Save.
  SavedState saved();

  /// True when the next tick will advance time: not paused, or steps are requested.
  bool running() const;

  const desc::World& world() const;  // settings as loaded; its models are those of the file
  std::uint64_t seed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::sim
