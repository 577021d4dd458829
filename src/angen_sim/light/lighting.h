#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "core/slots.h"
#include "core/time.h"
#include "light/allowance.h"
#include "light/lamp.h"
#include "light/probe.h"
#include "rays/scene.h"

/// Lux at a point from lamps, surfaces and rays.
namespace angen::light {

class Field;
class ReflectedLight;
struct Solution;
struct Source;
struct Unfinished;

class Lighting {
 public:
  explicit Lighting(const rays::Scene& scene);
  ~Lighting();

  LampId add(const Lamp& lamp, double level);
  void remove(LampId lamp);
  void set_level(LampId lamp, double level);  // share of luminous_flux; 0 and less is dark
  double level(LampId lamp) const;
  void move(LampId lamp, const Pose& pose);
  std::vector<Lit> lit() const;  // those of a level above 0
  bool dark() const { return lit_count_ == 0; }
  /// Grows when a lamp that is lit comes, goes, moves or changes its level.
  std::uint64_t lit_revision() const { return lit_revision_; }

  /// Illuminance at pose.position on the plane whose normal is pose's x axis, and the mean colour
  /// that a square pixel of 60 degrees along x sees: a mean luminance of L cd/m^2 gives L / (L +
  /// 50) in each channel. Direct light with shadows, plus what diffuse surfaces reflect: balanced
  /// between patches of all that is static or anchored, then gathered here over 2048 directions, in
  /// which moving shapes block and reflect. Albedos above 0.9 count as 0.9. A shape around a lamp
  /// or around the place keeps the light out, the sensor's own housing too: leave it out of the
  /// scene or put the place before it. The scene must be committed. Same scene, same lamps, same
  /// pose: same bits, whatever was measured before. One thread at a time. After pace() the light
  /// between surfaces is what advance() has found so far: of a new lamp at first what comes
  /// straight or after one reflection. All probes that are measured `ahead` share a budget of rays
  /// for each tick. Where that is used up, or where surfaces are seen that no solution has reached
  /// yet, a lamp counts as it was last found to, and advance() finds it anew. The first query of a
  /// probe finds everything, unless expect() has been called. `still` says that since the last time
  /// no shape has moved, come or gone within the probe's reach, so that lamps are not looked for
  /// again whose light takes the same ways as then.
  Sample measure(Probe& probe, const Pose& pose, bool still = false) const;

  /// What surfaces reflect onto each other, of all lamps that are lit, as far as it is known; see
  /// measure().
  std::shared_ptr<const ReflectedLight> reflected() const;

  /// Whether the place has been measured before.
  bool knows(const Probe& probe) const { return probe.lighting == id_; }

  /// From now on only advance() finds light between surfaces, but what measure() needs now. The
  /// scene must be committed.
  void pace();
  /// Has advance() begin, so that less is left for pace().
  void prepare();
  /// The same, for a query of that probe some time later.
  void expect(Probe& probe, const Pose& pose);
  /// Begins a tick: measure() has its budget again.
  void begin_tick() { budget_ = kMeasureRays; }
  /// Finds what measure() needs of the lamps that are lit: that of lamps that were switched on or
  /// came, and anew where standing shapes have come, gone or moved, once they have rested for 0.1
  /// s, or else once a second; and what of it comes to each probe that is measured `ahead`. It
  /// takes some 5 ms of CPU time at most, and over time less than what passes. How long
  /// it all takes depends on what happened and when (`now`), and on which of these probes there
  /// are, not on what was measured. The scene must be committed.
  void advance(Nanoseconds now);
  /// Whether advance() has been asked for.
  bool active() const { return active_; }
  /// Whether advance() has something to do, as far as is known.
  bool busy() const { return active_ && busy_; }

 private:
  struct Entry {
    Lamp lamp;
    double level;
    std::shared_ptr<const Solution> solution;  // null until it has been lit
    std::uint64_t geometry = 0;                // see Source
    bool stale = false;                        // lamp or shapes have changed since
    bool due = false;                          // to be found anew
  };
  struct Delivery {
    std::weak_ptr<Receiver> receiver;
    std::optional<LampId> lamp;  // without one only what the place sees is found
  };
  static constexpr std::size_t kMeasureRays = 12000;  // some 4 ms

  bool follow() const;
  void complete() const;
  bool may_wait(Nanoseconds now) const;
  void note(Nanoseconds now);
  bool due(Nanoseconds now) const;
  void take_up();
  void outline_new(std::int64_t& left);
  void update(std::int64_t& left);
  void solve_on(std::int64_t& left);
  void pick();
  void publish();
  std::optional<LampId> next() const;
  bool missing() const;
  void count(double before, double after);

  Receiver& receiver(Probe& probe, const Pose& pose) const;
  template <class F>
  void each_ahead(F&& visit) const;
  void queue(const std::shared_ptr<Receiver>& receiver, LampId lamp) const;
  void queue_all(LampId lamp) const;
  void drop_near(const Eigen::AlignedBox3d& box) const;
  void deliver();
  bool deliver(Receiver& receiver, LampId lamp, std::int64_t& left);
  bool affords(Receiver& receiver, const Source& source) const;
  Source source(LampId id, const Entry& entry) const;
  std::uint64_t key_of(const Source& source) const;
  void see(Receiver& receiver) const;
  void find(Receiver& receiver, const Source& source) const;

  const rays::Scene& scene_;
  mutable Slots<Entry, LampTag> lamps_;
  std::unique_ptr<Field> field_;
  mutable std::vector<std::weak_ptr<Receiver>> receivers_;  // of all probes
  mutable std::unique_ptr<Unfinished> work_;                // on the solution of `worked_on_`
  bool work_moved_ = false;                                 // its lamp has, since
  LampId worked_on_;
  Allowance solving_;     // for light between surfaces
  Allowance delivering_;  // for what of it comes to places
  mutable std::deque<Delivery> deliveries_;
  mutable std::size_t budget_ = kMeasureRays;  // that measure() has left in this tick
  bool active_ = false;
  bool paced_ = false;
  mutable bool busy_ = false;
  mutable bool changed_ = false;          // something, since the last advance()
  bool waiting_ = false;                  // for changes to end
  Nanoseconds followed_ = INT64_MIN / 2;  // when advance() last looked for changes
  Nanoseconds first_change_ = 0;          // of those that wait
  Nanoseconds last_change_ = 0;           // the same
  std::uint64_t id_;                      // no two Lightings share one
  std::size_t lit_count_ = 0;
  mutable std::shared_ptr<const ReflectedLight> reflected_;  // null until it is queried
  mutable std::uint64_t reflected_revision_ = 0;             // the lit_revision_ that it is of
  std::uint64_t lit_revision_ = 0;
};

}  // namespace angen::light
