#pragma once

#include <optional>

#include "devices/profile.h"
#include "devices/refresh.h"
#include "plugin/plugin.h"

namespace angen::devices {

/// m^3 that an upright cylinder of this radius and height (m) still holds when it is tilted (rad).
double held_volume(double radius, double height, double tilt);

/// A cup with a drink in it: it cools, adds its weight, and runs out over the lip. A
/// hand lifts and tilts it.
class Cup : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  void save(SavedParams& params) const override;
  Nanoseconds idle_until(const View& view) const override;

 private:
  struct Grasp {
    Pose pose;  // where the hand took it
    double height = 0.0;
    double tilt = 0.0;
    bool releases = false;
  };

  double capacity() const;
  double heat_capacity() const;        // J/K, of cup and drink
  double air(const View& view) const;  // degrees Celsius, around it
  Verdict fill(double volume, const View& view);
  void cool(Nanoseconds now, double air);
  void spill(double tilt, Outputs& outputs);
  void carry(const View& view, const LinkView& body, Outputs& outputs);
  void weigh(const View& view, Outputs& outputs) const;

  LinkRef body_;
  double mass_ = 0.0;              // kg, empty
  double radius_ = 0.0;            // m, inside
  double height_ = 0.0;            // m, inside
  double floor_ = 0.0;             // m, from the link's origin up to the inside
  double center_ = 0.0;            // m, from the link's origin up to its center of mass
  double heat_loss_ = 0.0;         // W/K
  double cup_heat_ = 0.0;          // J/K
  double fill_temperature_ = 0.0;  // degrees Celsius
  double hand_force_ = 0.0;        // N

  double content_ = 0.0;  // ml
  double poured_ = 0.0;   // ml, since the start
  std::optional<double> temperature_;
  int unknown_air_ = 0;  // updates, until a climate has reported the air that it starts at
  bool pours_ = false;
  bool changed_ = false;  // its weight did, while it may have been asleep
  Nanoseconds cooled_at_ = -1;
  Nanoseconds spilled_at_ = -1;
  std::optional<Grasp> grasp_;
  Profile lift_{0.4, 2.0};  // m/s, m/s^2
  Profile turn_{1.5, 6.0};  // rad/s, rad/s^2
  Refresh due_{0.1};
};

}  // namespace angen::devices
