#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>

namespace angen::light {

struct Receiver;

/// A place of measurement with its cached light; a sensor owns it.
struct Probe {
  /// m, world: anchored and moving shapes outside of it are on no light path to the place. Infinite
  /// if light may come from anywhere.
  Eigen::AlignedBox3d reach;
  std::shared_ptr<Receiver> receiver;
  std::uint64_t lighting = UINT64_MAX;  // the Lighting of `receiver`
};

struct Sample {
  double illuminance = 0.0;                         // lx on a plane through the point, normal x
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // mean color of the view, 0..1 (tone mapped)
};

}  // namespace angen::light
