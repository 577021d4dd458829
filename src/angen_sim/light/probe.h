#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>

namespace angen::light {

struct Receiver;

/// A place of measurement, and what is known of the light that comes to it. Held by a sensor.
struct Probe {
  /// Lighting::advance finds ahead of measure() what comes to the place, and measure() does no more
  /// than a bounded share of it: see there.
  bool ahead = false;
  /// m, world: anchored and moving shapes outside of it are in no way of light to the place.
  /// Infinite where light may come from anywhere.
  Eigen::AlignedBox3d reach;
  std::shared_ptr<Receiver> receiver;
  std::uint64_t lighting = UINT64_MAX;  // whose that is
};

struct Sample {
  double illuminance = 0.0;                         // lx on a plane through the point, normal x
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // mean colour of the view, 0..1 (tone mapped)
};

}  // namespace angen::light
