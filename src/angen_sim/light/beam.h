#pragma once

#include "light/lighting.h"

namespace angen::light {

/// What a lamp at level 1 sends to a point when nothing stands between.
struct Beam {
  Vec3 towards = Vec3::UnitZ();  // unit, from the point to the lamp
  double distance = 0.0;         // m; infinite for a directional lamp
  double illuminance = 0.0;      // lx on a plane facing the lamp
};

/// Inverse square down to the lamp's radius; within that the light of its surface.
Beam beam(const Lamp& lamp, const Vec3& point);

/// Share (0..1) of the lamp's sphere that the point sees; 1 where the lamp casts no shadows.
double visible_share(const rays::Scene& scene, const Lamp& lamp, const Beam& beam,
                     const Vec3& point);

/// Whether the point sees one of the lamp's sixteen points: `which` picks it.
bool sees_one(const rays::Scene& scene, const Lamp& lamp, const Beam& beam, const Vec3& point,
              std::size_t which);

}  // namespace angen::light
