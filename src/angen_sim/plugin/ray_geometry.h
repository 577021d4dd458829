#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "plugin/kind.h"
#include "plugin/params.h"

namespace angen {

/// The rays of a sensor in its own frame (x forward, z up), for code that draws or checks them.
struct RayGeometry {
  int columns = 1;
  int rows = 1;
  double min_yaw = 0.0;  // rad, positive to the left
  double max_yaw = 0.0;
  double min_pitch = 0.0;  // rad, positive upwards
  double max_pitch = 0.0;
  double min = 0.0;           // m, nearer is not seen
  double max = 0.0;           // m, length of a ray that hits nothing
  std::vector<double> tilts;  // rad upwards, of all rays: of each sample in turn; empty: never
  std::vector<Vec3> zones;    // unit vectors in which it detects, if its rays only show where

  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }

  /// Unit vectors, row after row from below, all of them tilted upwards by `tilt` rad.
  std::vector<Vec3> directions(double tilt = 0.0) const;

  /// Unit vectors in which it detects, at all of its tilts.
  std::vector<Vec3> detecting() const;

  /// The tilt of sample number `samples`, from 0.
  double tilt(std::int64_t samples) const {
    if (tilts.empty() || samples < 0) return 0.0;
    return tilts[static_cast<std::size_t>(samples) % tilts.size()];
  }
};

/// Reads <scan> and <range> of <ray>; `fallback` has the default values.
RayGeometry read_rays(Params& params, const RayGeometry& fallback);

/// Reads <color> of a sensor whose rays rviz draws: r g b and, if it is given, alpha, each 0 to 1.
Eigen::Vector4f read_ray_color(Params& params, const Kind& kind);

}  // namespace angen
