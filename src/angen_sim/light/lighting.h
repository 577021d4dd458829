#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/pose.h"
#include "core/time.h"
#include "light/lamp.h"
#include "light/probe.h"
#include "rays/scene.h"

/// Lux at a point from lamps, surfaces and rays.
namespace angen::light {

class ReflectedLight;

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
  bool dark() const;
  /// Grows when a lit lamp is added, removed, moved or changes its level, and with each solution.
  std::uint64_t lit_revision() const;

  /// Illuminance at pose.position on the plane whose normal is pose's x axis, and the mean
  /// color that a square pixel of 60 degrees along x sees: a mean luminance of L cd/m^2 gives L /
  /// (L + 50) in each channel. Direct light with shadows, plus diffuse reflections: radiosity
  /// between the patches of static and anchored shapes, then a final gather over 2048 directions,
  /// in which moving shapes block and reflect. Albedos above 0.9 count as 0.9. A shape around a
  /// lamp or around the place keeps the light out, also the sensor's own housing: leave it out of
  /// the scene or put the place in front of it. The scene must be committed. One thread at a time.
  /// Same scene, lamps and pose give the same bits, whatever was measured before; after keep_time()
  /// the light between surfaces is that of the scene which advance() took over last. `still`: no
  /// shape was moved, added or removed within the probe's reach since the last query, so light on
  /// unchanged paths is not computed again.
  Sample measure(Probe& probe, const Pose& pose, bool still = false) const;

  /// Light that surfaces reflect onto each other, of all lit lamps, as far as known; see measure().
  std::shared_ptr<const ReflectedLight> reflected() const;

  /// Whether the place has been measured before.
  bool knows(const Probe& probe) const;

  /// From now on, standing shapes that were added, removed or moved and lamps that were switched on
  /// are taken over by advance(), no longer by each measurement.
  void keep_time();
  bool keeps_time() const;
  /// To be called in each tick at or after next(). Starts to find the light of the present scene,
  /// on another thread: at once for lamps that were switched on and whose light in it is unknown,
  /// else when nothing standing has changed for 0.1 s, or 5 s after the first change. 0.1 s later,
  /// it waits for that light and takes it over as a whole: until then lamps have the light of
  /// before, and a lamp without one is dark. The scene must be committed.
  void advance(Nanoseconds now);
  /// Begins to find the light of lamps that were dark so far, on another thread, so that less is
  /// left to find when they are lit. No result depends on it. The scene must be committed.
  void look_ahead();
  /// Whether look_ahead() may have something to do; it needs keep_time().
  bool may_look_ahead() const;
  /// When advance() has something to do, if no standing shape changes before.
  std::optional<Nanoseconds> next() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::light
