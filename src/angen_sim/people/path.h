#pragma once

#include <vector>

#include "core/time.h"

namespace angen::people {

/// Waypoints on the floor, in straight lines, each reached at its time.
class Path {
 public:
  struct Waypoint {
    Nanoseconds time = 0;
    double x = 0.0, y = 0.0;  // m
    double yaw = 0.0;         // rad
  };
  struct Place {
    double x = 0.0, y = 0.0;    // m
    double vx = 0.0, vy = 0.0;  // m/s
    double yaw = 0.0;           // rad: along its way, or of the waypoint where it waits

    bool still() const { return vx == 0.0 && vy == 0.0; }
  };

  Path() = default;
  /// Times must rise; at() needs at least one waypoint. A loop whose ends lie apart is closed by a
  /// walk of 1 m/s.
  Path(std::vector<Waypoint> waypoints, bool loop);

  Place at(Nanoseconds time) const;
  /// The first time from `time` on at which it is not still; kForever when there is none.
  Nanoseconds still_until(Nanoseconds time) const;
  bool empty() const { return waypoints_.empty(); }

 private:
  static bool is_pause(const Waypoint& from, const Waypoint& to);

  std::vector<Waypoint> waypoints_;
  bool loop_ = false;
};

}  // namespace angen::people
