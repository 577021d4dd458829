#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "core/slots.h"
#include "core/time.h"
#include "light/lamp.h"
#include "light/probe.h"
#include "rays/scene.h"

/// Lux at a point from lamps, surfaces and rays.
namespace angen::light {

class Field;
class ReflectedLight;
struct Solution;
struct Receiver;
struct Source;

class Lighting {
 public:
  explicit Lighting(const rays::Scene& scene);
  ~Lighting();

  LampId add(const Lamp& lamp, double level);
  void remove(LampId lamp);
  void set_level(LampId lamp, double level);  // share of luminous_flux; 0 and less is dark
  double level(LampId lamp) const;
  void move(LampId lamp, const Pose& pose);
  std::vector<Lit> lit() const;  // lamps of a level above 0
  bool dark() const { return lit_count_ == 0; }
  /// Grows when a lit lamp is added, removed, moved or changes its level, and with each solution.
  std::uint64_t lit_revision() const { return lit_revision_; }

  /// Illuminance at pose.position on the plane whose normal is pose's x axis, and the mean color
  /// that a square pixel of 60 degrees along x sees: a mean luminance of L cd/m^2 gives L / (L +
  /// 50) in each channel. Direct light with shadows, plus diffuse reflections: radiosity between
  /// the patches of static and anchored shapes, then a final gather over 2048 directions, in which
  /// moving shapes block and reflect. Albedos above 0.9 count as 0.9. A shape around a lamp or
  /// around the place keeps the light out, also the sensor's own housing: leave it out of the scene
  /// or put the place in front of it. The scene must be committed. One thread at a time.
  /// Same scene, lamps and pose give the same bits, whatever was measured before; after keep_time()
  /// the light between surfaces is that of the scene which advance() took over last. `still`: no
  /// shape was moved, added or removed within the probe's reach since the last query, so light on
  /// unchanged paths is not computed again.
  Sample measure(Probe& probe, const Pose& pose, bool still = false) const;

  /// Light that surfaces reflect onto each other, of all lit lamps, as far as known; see measure().
  std::shared_ptr<const ReflectedLight> reflected() const;

  /// Whether the place has been measured before.
  bool knows(const Probe& probe) const { return probe.lighting == id_; }

  /// From now on, standing shapes that were added, removed or moved are taken over by advance(), no
  /// longer by each measurement.
  void keep_time();
  bool keeps_time() const { return keeps_time_; }
  /// To be called in each tick at or after next(). Takes the scene over at once for lamps that were
  /// switched on and whose light in it is unknown, else when nothing standing has changed for 0.1
  /// s, or 5 s after the first change. The scene must be committed.
  void advance(Nanoseconds now);
  /// When advance() has something to do, if no standing shape changes before.
  std::optional<Nanoseconds> next() const;

 private:
  struct Entry {
    Lamp lamp;
    double level;
    std::shared_ptr<const Solution> solution;  // of the scene that was taken over last, or null
    std::uint64_t geometry = 0;                // see Source
    bool moved = false;                        // since it was solved
    bool switched_on = false;                  // since the last follow()
  };

  void follow() const;
  void take_over() const;
  bool lacks_light() const;
  bool is_outdated(const Entry& entry) const;
  bool is_due(Nanoseconds now) const;
  void count(double before, double after);

  Receiver& receiver(Probe& probe, const Pose& pose) const;
  void drop_near(const Eigen::AlignedBox3d& box) const;
  void find(Receiver& receiver, const Source& source) const;

  const rays::Scene& scene_;
  mutable Slots<Entry, LampTag> lamps_;
  std::unique_ptr<Field> field_;
  mutable std::vector<std::weak_ptr<Receiver>> receivers_;  // receivers of all probes
  bool keeps_time_ = false;
  mutable bool changed_ = false;   // shapes or lamps, since the last advance()
  mutable bool switched_ = false;  // a lamp that lacks light may have been switched on
  mutable bool waiting_ = false;   // for changes to end
  Nanoseconds first_change_ = 0;   // first of the waiting changes
  Nanoseconds last_change_ = 0;    // last of the waiting changes
  std::uint64_t id_;               // unique
  std::size_t lit_count_ = 0;
  mutable std::shared_ptr<const ReflectedLight> reflected_;  // null until it is queried
  // The lit_revision_, and the patches forgotten before, of `reflected_`.
  mutable std::pair<std::uint64_t, std::uint64_t> reflected_revision_{0, 0};
  mutable std::uint64_t lit_revision_ = 0;
};

}  // namespace angen::light
