#pragma once

#include "light/field.h"
#include "light/lamp.h"

namespace angen::light {

/// Light of one lamp, taken as white, that surfaces reflect to a place.
struct Gathered {
  Rgb illuminance = Rgb::Zero();  // lx
  Rgb view = Rgb::Zero();         // mean lx that leave the surfaces in the one-pixel view
};

/// Light of one lamp at level 1 at one place.
struct Transport {
  double illuminance = 0.0;                            // lx
  Eigen::Vector3f radiance = Eigen::Vector3f::Zero();  // mean of a one-pixel view, r g b in cd/m^2
  Eigen::AlignedBox3d reach;  // m, world: of the light paths that movers could block
};

void make_infinite(Eigen::AlignedBox3d& box);

/// Extends the reach to a lamp; makes it infinite if the lamp is directional.
void extend(Eigen::AlignedBox3d& reach, const Lamp& lamp);

/// Direct plus gathered light. `reach` is that of `gathered`.
Transport transport(const rays::Scene& scene, const Pose& pose, const Lamp& lamp,
                    const Gathered& gathered, const Eigen::AlignedBox3d& reach);

}  // namespace angen::light
