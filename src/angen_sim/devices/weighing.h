#pragma once

#include <string>

#include "plugin/plugin.h"

namespace angen::devices {

/// Weighs the load of an elevator, by the force on its brake, and finds an overload.
class Weighing {
 public:
  void configure(Params& params);
  /// kg, of the cabin with its doors.
  void set_own_mass(double mass) { own_mass_ = mass_ = mass; }

  double mass() const { return mass_; }  // kg, of the cabin with its load
  double load() const;                   // kg, not negative
  bool overloaded() const { return overloaded_; }
  /// More than is allowed, by the last weighing.
  bool is_heavy() const;
  /// The mass that a weighing now gives; the brake carries cabin and load.
  double weigh(const JointView& lift, const View& view) const;
  void take(double mass) { mass_ = mass; }
  /// Each tick: an overload begins and ends after the load has settled.
  void watch(const View& view);
  /// Warns where the joint is too weak for the load in the file.
  void warn_of_effort(Params& params, double effort, const std::string& lift) const;
  /// "700 kg of 630 kg".
  std::string detail() const;

 private:
  double own_mass_ = 0.0;
  double mass_ = 0.0;
  double rated_load_ = 0.0;  // kg
  bool overloaded_ = false;
  Nanoseconds load_since_ = 0;  // the last time when is_heavy() agreed with that
};

}  // namespace angen::devices
