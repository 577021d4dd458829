#pragma once

#include "light/lamp.h"
#include "rays/scene.h"

namespace angen::light {

/// Unobstructed light of a lamp at level 1 at a point, as if all came from the lamp's center.
struct Beam {
  Vec3 towards = Vec3::UnitZ();  // unit, from the point to the lamp
  double distance = 0.0;         // m; infinite for a directional lamp
  double illuminance = 0.0;      // lx on a plane facing the lamp
};

/// Inverse-square law, with the distance clamped to the lamp's radius.
Beam beam(const Lamp& lamp, const Vec3& point);

/// Unobstructed lx on the plane through `point` with the unit `normal`. Exact for flat lamps
/// (Lambert's formula for a uniform diffuse polygon; a disc is approximated by 64 sides).
double illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal);

/// Visible share (0..1) of the lamp's light on that plane, with the shapes `among` as occluders; 1
/// if the lamp casts no shadows.
double visible_share(const rays::Scene& scene, const Lamp& lamp, const Vec3& point,
                     const Vec3& normal, rays::Mobilities among);

/// Whether the point sees the lamp's sample point `which` (modulo kLampPoints); true if the lamp
/// casts no shadows.
bool sees_one(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, std::size_t which,
              rays::Mobilities among);

/// Sample point `which` (modulo kLampPoints) of a lamp, m, world: on its sphere, a tube's axis or a
/// flat lamp's face.
Vec3 lamp_point(const Lamp& lamp, std::size_t which);

}  // namespace angen::light
