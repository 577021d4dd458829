#pragma once

#include <cstdint>

#include "light/field.h"

namespace angen::light {

/// What surfaces send to a place of one lamp's light, were it white.
struct Gathered {
  Rgb illuminance = Rgb::Zero();  // lx
  Rgb view = Rgb::Zero();         // lx leaving what the one-pixel view sees, their mean
};

/// What one lamp at level 1 sends to one place.
struct Transport {
  double illuminance = 0.0;                            // lx
  Eigen::Vector3f radiance = Eigen::Vector3f::Zero();  // mean of a one-pixel view, r g b in cd/m^2
  Eigen::AlignedBox3d reach;  // of the ways of its light on which shapes that move could stand
};

void make_infinite(Eigen::AlignedBox3d& box);

/// By the ways to a lamp from what is in it.
void extend(Eigen::AlignedBox3d& reach, const Lamp& lamp);

/// Straight and by way of surfaces. `reach` is that of `gathered`.
Transport transport(const rays::Scene& scene, const Pose& pose, const Lamp& lamp,
                    const Gathered& gathered, const Eigen::AlignedBox3d& reach);

}  // namespace angen::light
