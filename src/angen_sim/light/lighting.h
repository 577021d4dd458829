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
  // About 4 s of CPU time; all twelve lamps of the building cost 12 million.
  static constexpr std::int64_t kRaysToLoad = 15'000'000;
  static constexpr std::int64_t kRaysToJoin = 300'000;  // while a world runs

  explicit Lighting(const rays::Scene& scene);
  ~Lighting();

  LampId add(const Lamp& lamp, double level);
  void remove(LampId lamp);
  void set_level(LampId lamp, double level);  // share of luminous_flux; 0 and less is dark
  double level(LampId lamp) const;
  void move(LampId lamp, const Pose& pose);
  std::vector<Lit> lit() const;  // lamps of a level above 0
  bool dark() const { return lit_count_ == 0; }
  /// Grows when a lit lamp is added, removed, moved or changes its level, and with each new result.
  std::uint64_t lit_revision() const { return lit_revision_; }

  /// Illuminance at pose.position on the plane whose normal is pose's x axis, and the mean color
  /// that a square pixel of 60 degrees along x sees: a mean luminance of L cd/m^2 gives L / (L +
  /// 50) in each channel. Direct light with shadows, plus diffuse reflections: radiosity between
  /// the patches of static and anchored shapes, then a final gather over 2048 directions, in which
  /// moving shapes block and reflect. Albedos above 0.9 count as 0.9. A shape around a lamp or
  /// around the place keeps the light out, also the sensor's own housing: leave it out of the scene
  /// or put the place in front of it. The scene must be committed. One thread at a time.
  /// Same scene, lamps and pose give the same bits, whatever was measured before. After pace(), the
  /// reflected light is the one that advance() has found so far; a new lamp has direct light and
  /// one reflection at first. All probes that are measured `ahead` share a budget of rays for each
  /// tick. When it is used up, or where no solution contains the surfaces in view, a lamp's last
  /// known light counts, and advance() updates it. The first query of a probe computes everything,
  /// unless expect() was called. `still`: no shape was moved, added or removed within the probe's
  /// reach since the last query, so light on unchanged paths is not computed again.
  Sample measure(Probe& probe, const Pose& pose, bool still = false) const;

  /// Light that surfaces reflect onto each other, of all lit lamps, as far as known; see measure().
  std::shared_ptr<const ReflectedLight> reflected() const;

  /// Whether the place has been measured before.
  bool knows(const Probe& probe) const { return probe.lighting == id_; }

  /// Computes light between surfaces now, for a cost of about `rays` rays; light beyond that is
  /// found as that of new lamps. From then on only advance() does, and measure() where it must. The
  /// scene must be committed.
  void pace(std::int64_t rays = kRaysToLoad);
  /// Activates advance(), so that less is left for pace().
  void prepare();
  /// Prepares a later query of that probe likewise.
  void expect(Probe& probe, const Pose& pose);
  /// Begins a tick: resets the budget of measure().
  void begin_tick() { budget_ = kMeasureRays; }
  /// Computes the reflected light of lit lamps: at once for new ones, and again where standing
  /// shapes were added, removed or moved, after 0.1 s without a change, or else once a second. Then
  /// computes the light at each probe that is measured `ahead`. Takes about 5 ms of CPU time at
  /// most, and less than simulated time on average. When a result is complete depends on the events
  /// and their times (`now`) and on these probes, not on measurements. The scene must be
  /// committed.
  void advance(Nanoseconds now);
  /// Whether prepare() or pace() was called.
  bool active() const { return active_; }
  /// Whether advance() has something to do, as far as known.
  bool busy() const { return active_ && busy_; }

 private:
  struct Entry {
    Lamp lamp;
    double level;
    std::shared_ptr<const Solution> solution;  // null until it has been lit
    std::uint64_t geometry = 0;                // see Source
    bool stale = false;                        // the lamp or shapes have changed since
    bool due = false;                          // to be solved again
  };
  struct Delivery {
    std::weak_ptr<Receiver> receiver;
    std::optional<LampId> lamp;  // without one, only the surfaces around the place are found
  };
  static constexpr std::size_t kMeasureRays = 12000;  // about 4 ms

  bool follow() const;
  bool complete(std::int64_t rays) const;
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
  void note_solved();

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
  mutable std::vector<std::weak_ptr<Receiver>> receivers_;  // receivers of all probes
  mutable std::unique_ptr<Unfinished> work_;                // for the solution of `worked_on_`
  bool work_moved_ = false;                                 // its lamp has moved since
  LampId worked_on_;
  Allowance solving_;     // for light between surfaces
  Allowance delivering_;  // for light at places
  mutable std::deque<Delivery> deliveries_;
  mutable std::size_t budget_ = kMeasureRays;  // rays that measure() has left in this tick
  bool active_ = false;
  bool paced_ = false;
  mutable bool busy_ = false;
  mutable bool changed_ = false;          // since the last advance()
  bool waiting_ = false;                  // for changes to end
  Nanoseconds followed_ = INT64_MIN / 2;  // when advance() last looked for changes
  Nanoseconds first_change_ = 0;          // first of the waiting changes
  Nanoseconds last_change_ = 0;           // last of the waiting changes
  std::uint64_t id_;                      // unique
  std::size_t lit_count_ = 0;
  mutable std::shared_ptr<const ReflectedLight> reflected_;  // null until it is queried
  // The solved_revision_, and the patches forgotten before, of `reflected_`.
  mutable std::pair<std::uint64_t, std::uint64_t> reflected_revision_{0, 0};
  std::uint64_t lit_revision_ = 0;
  std::uint64_t solved_revision_ = 0;  // grows with levels and solutions of lamps
};

}  // namespace angen::light
