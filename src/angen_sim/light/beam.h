#pragma once

#include "light/lamp.h"

/// Unobstructed light of lamps.
namespace angen::light {

/// Unit vectors along a flat lamp's width and height; a tube's length is along the first.
struct Axes {
  Vec3 along, across;
};

Axes axes_of(const Lamp& lamp);

/// Unobstructed light of a lamp at level 1 at a point, as if all came from the lamp's center.
struct Beam {
  Vec3 towards = Vec3::UnitZ();  // unit, from the point to the lamp
  double distance = 0.0;         // m; infinite for a directional lamp
  double illuminance = 0.0;      // lx on a plane facing the lamp
};

/// Inverse-square law, with the distance clamped to the lamp's radius.
Beam beam(const Lamp& lamp, const Vec3& point);

/// Unobstructed lx on the plane through `point` with the unit `normal`. Exact for flat lamps and
/// tubes (Lambert's formula for a uniform diffuse polygon; 64 sides approximate a disc, 15 an arc).
double illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal);

}  // namespace angen::light
