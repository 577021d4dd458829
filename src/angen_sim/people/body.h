#pragma once

#include <optional>
#include <vector>

#include "people/gait.h"
#include "plugin/plugin.h"
#include "plugin/wiring.h"

namespace angen::people {

/// A person's body: the warmth, vapor and sound that it gives to its surroundings, and its limbs.
class Body {
 public:
  void configure(Params& params, Wiring& wiring);
  void speak(bool speaks) { speaks_ = speaks; }
  /// `link` is the body as it is now.
  void update(const View& view, const LinkView& link, Outputs& outputs);
  void take(Posture posture) { gait_.take(posture_ = posture); }
  /// `speed` is that of its walk (m/s), none while it does not walk.
  void report(const View& view, std::optional<double> speed, Reading& state) const;
  void save(SavedParams& params) const { params.flag("speaking", speaks_); }
  void pose_limbs(std::vector<Pose>& limbs) const;
  /// When it will feel the air next, after `now`.
  static Nanoseconds feels_next(Nanoseconds now);

 private:
  void feel_air(const View& view, const Vec3& feet, Outputs& outputs);
  double sound(bool walks) const;

  Gait gait_;
  Posture posture_ = Posture::kStand;
  std::vector<SurfaceRef> surfaces_;
  double skin_ = 0.0;      // K, of head and hands
  double clothing_ = 0.0;  // K, of the rest
  bool skin_follows_ = true;
  bool clothing_follows_ = true;
  double air_ = 0.0;           // K, of the air around it; 0: not felt yet
  double humidity_ = 50.0;     // percent, of that air
  Nanoseconds felt_at_ = -1;   // time of the last air, as a multiple of a period
  double warmth_ = 0.0;        // K, of its surface
  double surface_ = 1.0;       // its body's, as a share of a usual person's
  double step_sound_ = 0.0;    // dB over 1 pW
  double speech_sound_ = 0.0;  // dB over 1 pW
  bool speaks_ = false;
  bool spoke_ = false;  // at the last update
};

}  // namespace angen::people
