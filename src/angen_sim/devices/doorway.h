#pragma once

#include <vector>

#include "devices/profile.h"
#include "plugin/plugin.h"

namespace angen::devices {

/// Sliding leaves that open and shut together, each shut at 0. Force-limited motors move them along
/// one profile. They open again where a light curtain from leaf to leaf finds something between
/// them, or where something holds them.
class Doorway {
 public:
  enum class Mode { kClosed, kOpen, kOpening, kClosing, kBlocked };
  struct Leaf {
    JointRef joint;
    double open = 0.0;  // m, open position
    LinkRef link;
    Vec3 center = Vec3::Zero();  // m, of its mass, in the link's frame
    Vec3 axis = Vec3::UnitX();   // axis of its joint, in the model's frame
    int row = 0;                 // leaves of one row close towards each other
  };

  Doorway() = default;
  /// Limits in m/s and N.
  Doorway(double max_velocity, double max_force);

  /// Selects the leaves that move from now on. Their brakes must hold; the mode follows from their
  /// positions.
  void select(std::vector<Leaf> leaves, const View& view);
  void open(const View& view);
  void close(const View& view);
  /// Moves the leaves. True when an obstacle has just made it open again.
  bool update(const View& view, Outputs& outputs);

  Mode mode() const { return mode_; }
  bool moving() const { return moving_; }
  double position(const View& view) const;  // m, mean opening of the leaves, 0 shut
  static void brake(const Leaf& leaf, double max_force, Outputs& outputs);

 private:
  double share(const View& view) const;  // 0 shut, 1 open: mean of the leaves
  bool curtain_broken(const View& view);
  static bool is_between(const Leaf& one, const Leaf& other, const View& view);
  void go(bool opening, const View& view);

  std::vector<Leaf> leaves_;
  Profile profile_;  // profile of the widest leaf, m
  double max_velocity_ = 0.5;
  double max_force_ = 100.0;
  double travel_ = 0.0;          // m, of the widest leaf
  double stalled_ = 0.0;         // s
  Nanoseconds scanned_at_ = -1;  // by the curtain, as a multiple of its period
  bool moving_ = false;
  bool opening_ = false;
  Mode mode_ = Mode::kClosed;
};

}  // namespace angen::devices
