#pragma once

#include "light/lamp.h"
#include "rays/scene.h"

namespace angen::light {

/// What a lamp at level 1 sends to a point when nothing stands between, as if from its middle.
struct Beam {
  Vec3 towards = Vec3::UnitZ();  // unit, from the point to the lamp
  double distance = 0.0;         // m; infinite for a directional lamp
  double illuminance = 0.0;      // lx on a plane facing the lamp
};

/// Inverse square down to the lamp's radius; within that the light of its surface.
Beam beam(const Lamp& lamp, const Vec3& point);

/// lx on the plane with the unit `normal` when nothing stands between. Exact for flat lamps
/// (Lambert's formula for a uniform diffuse polygon; a disc counts as one of 64 sides).
double illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal);

/// Share (0..1) of the lamp's light on that plane that shapes `among` leave it; 1 where the lamp
/// casts no shadows.
double visible_share(const rays::Scene& scene, const Lamp& lamp, const Vec3& point,
                     const Vec3& normal, rays::Mobilities among);

/// Whether the point sees one of the lamp's kLampPoints points: `which` picks it.
bool sees_one(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, std::size_t which,
              rays::Mobilities among);

/// One of a lamp's points, and for a flat lamp one of its surface.
Vec3 lamp_point(const Lamp& lamp, std::size_t which);

}  // namespace angen::light
