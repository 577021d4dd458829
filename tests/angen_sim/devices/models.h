#pragma once

#include <string>

#include "desc/world.h"

/// Small models to put devices on. Meters, kg, radians.
namespace angen::test {

desc::Link box_link(const std::string& name, const Vec3& at, const Vec3& size, double mass);

/// One box; static or loose.
desc::Model box(const std::string& name, const Vec3& at, const Vec3& size, double mass = 0.0);
desc::Model ground(double z = 0.0);

struct DoorMeasures {
  double mass = 20.0;
  double width = 0.9;
  double damping = 1.0;   // N m s/rad
  double friction = 0.5;  // N m
  double angle = 0.0;     // at the start
};
/// Its hinge is at the origin; shut, the leaf lies along +x. Base is static.
desc::Model door(const DoorMeasures& measures = {});

/// Cabin floor at z = 0 when at floor 0, inner 1.4 m by 1.4 m, open towards -y where its doors are;
/// landing doors on both floors.
desc::Model elevator(double cabin_mass = 400.0);

/// Like a TurtleBot: 6.3 kg, wheels of 0.07 m, 0.23 m apart, two sliding casters.
desc::Model robot(const Vec3& at);

/// 70 kg, 0.5 m wide, 1.75 m high, stays upright.
desc::Model person(const Vec3& at);

}  // namespace angen::test
