#pragma once

#include "plugin/plugin.h"
#include "sensors/camera_params.h"

namespace angen::sensors {

/// A depth camera that looks along its x axis, z up: distances along the axis, not along the rays.
/// With an <imageTopicName> it is a color camera as well, and has the defaults of Gazebo's.
class Depth : public Sensor {
 public:
  /// Gazebo's plug-in sees no farther than `farthest` m.
  explicit Depth(double farthest) : farthest_(farthest) {}
  void configure(Params& params, Wiring& wiring) override;
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override;

 private:
  double farthest_;
  double nearest_ = 0.0;  // m
  Lens lens_;
  bool colored_ = false;
  bool in_millimeters_ = false;
};

Kind depth_kind(Kind kind);

}  // namespace angen::sensors
