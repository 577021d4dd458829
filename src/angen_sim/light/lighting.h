#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "core/slots.h"
#include "core/time.h"
#include "light/lamp.h"
#include "rays/scene.h"

/// Lux at a point from lamps, surfaces and rays.
namespace angen::light {

class Field;
class Gather;
struct Solution;
struct Unfinished;

/// What one lamp at level 1 sends to one place.
struct Transport {
  LampId lamp;
  std::uint64_t solution = 0;                          // the stamp of the one it belongs to
  double illuminance = 0.0;                            // lx
  Eigen::Vector3f radiance = Eigen::Vector3f::Zero();  // mean of a one-pixel view, r g b in cd/m^2
};

/// A place of measurement that remembers its transports while geometry stands still. A plain value,
/// held by a sensor.
struct Probe {
  Pose pose;
  std::uint64_t revision = UINT64_MAX;  // of the scene and lamp set that `transports` belong to
  std::uint64_t walls = 0;              // changes of static shapes that are taken into account
  std::uint64_t lamps_revision = UINT64_MAX;
  std::vector<Transport> transports;
  std::shared_ptr<Gather> gather;  // what the place sees of what stands still
  /// m, world: anchored and moving shapes outside of it are in no way of light to the place.
  /// Infinite where light may come from anywhere.
  Eigen::AlignedBox3d reach;
};

/// A lamp that shines, and at what share of its flux.
struct Lit {
  Lamp lamp;
  double level = 0.0;
};

struct Sample {
  double illuminance = 0.0;                         // lx on a plane through the point, normal x
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // mean colour of the view, 0..1 (tone mapped)
};

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
  /// between surfaces is what advance() has found so far, and a lamp whose light it has not found
  /// yet gives none.
  /// `still` says that since the last time no shape has moved, come or gone within the probe's
  /// reach, so that lamps are not looked for again whose light takes the same ways as then.
  Sample measure(Probe& probe, const Pose& pose, bool still = false) const;

  /// Whether the place has been measured before.
  bool knows(const Probe& probe) const {
    return probe.lamps_revision >> 32 == lamps_revision_ >> 32;
  }

  /// From now on only advance() finds light between surfaces, but what measure() needs now. The
  /// scene must be committed.
  void pace();
  /// Has advance() begin, so that less is left for pace().
  void prepare();
  /// Finds what measure() needs of the lamps that are lit, for some 5 ms of CPU time: that of lamps
  /// that were switched on or came, and anew where standing shapes have come, gone or moved, once
  /// they have rested for 0.1 s, or else once a second. How long that takes depends on what
  /// happened and when (`now`), not on what was measured. The scene must be committed.
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
    std::weak_ptr<Gather> gather;
    LampId lamp;
  };

  bool follow() const;
  void complete() const;
  void note(Nanoseconds now);
  bool due(Nanoseconds now) const;
  void take_up();
  void pick();
  void publish();
  void deliver();
  std::optional<LampId> next() const;
  bool missing() const;
  void renew(Probe& probe, const Pose& pose, bool still) const;
  std::shared_ptr<Gather> make_gather(const Pose& pose) const;
  bool walls_changed(const Probe& probe) const;
  const Transport& find(Probe& probe, LampId id, Entry& entry) const;
  void count(double before, double after);

  const rays::Scene& scene_;
  mutable Slots<Entry, LampTag> lamps_;
  std::unique_ptr<Field> field_;
  mutable std::vector<std::weak_ptr<Gather>> gathers_;  // of all probes
  mutable std::vector<Eigen::AlignedBox3d> walls_;      // where static shapes came and went, latest
  mutable std::uint64_t walls_count_ = 0;               // of all there were
  mutable std::unique_ptr<Unfinished> work_;            // on the solution of `worked_on_`
  mutable std::vector<Eigen::AlignedBox3d> work_changes_;  // in the scene, since it began
  bool work_moved_ = false;                                // its lamp has, since
  LampId worked_on_;
  std::deque<Delivery> deliveries_;
  bool active_ = false;
  bool paced_ = false;
  mutable bool busy_ = false;
  mutable bool changed_ = false;  // something, since the last advance()
  bool waiting_ = false;          // for changes to end
  Nanoseconds first_change_ = 0;  // of those that wait
  Nanoseconds last_change_ = 0;   // the same
  std::uint64_t lamps_revision_;  // no two Lightings share one
  std::size_t lit_count_ = 0;
  std::uint64_t lit_revision_ = 0;
};

}  // namespace angen::light
