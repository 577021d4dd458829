#pragma once

#include "light/lamp.h"
#include "rays/scene.h"

/// Shadows: the part of a lamp that a point sees.
namespace angen::light {

/// Visible share (0..1) of the lamp's light on the plane through `point` with the unit `normal`,
/// with the shapes `among` as occluders; 1 if the lamp casts no shadows. Samples the lamp more
/// densely at the edges of shadows, until the share is accurate within 1 %, or within 0.02 lx at
/// level 1; an occluder that hides less than 2 % may be missed.
double visible_share(const rays::Scene& scene, const Lamp& lamp, const Vec3& point,
                     const Vec3& normal, rays::Mobilities among);

/// Whether any of the lamp's light reaches the plane, as far as the coarsest samples tell.
bool sees_any(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, const Vec3& normal,
              rays::Mobilities among);

/// Whether the point sees the lamp's sample point `which`; true if the lamp casts no shadows. The
/// samples are evenly spread over the lamp (kLampPoints), or, if it is flat and close, over the
/// light that arrives on the plane with the unit `normal`.
bool sees_one(const rays::Scene& scene, const Lamp& lamp, const Vec3& point, const Vec3& normal,
              std::size_t which, rays::Mobilities among);

/// Sample point `which` (modulo kLampPoints) of a lamp, m, world: on a tube's axis, on a flat
/// lamp's face or at the center of a globe.
Vec3 lamp_point(const Lamp& lamp, std::size_t which);

}  // namespace angen::light
