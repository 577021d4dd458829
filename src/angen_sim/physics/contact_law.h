#pragma once

#include "physics/model.h"
#include "physics/wheel_line.h"

namespace angen::physics {

/// What all contacts of a step have in common.
struct ContactSettings {
  double step = 0.0;  // s
  Vec3 gravity = Vec3::Zero();
  double erp = 0.0;
  double cfm = 0.0;
  double surface_layer = 0.0;  // m
  double fastest = 0.0;        // m/s, at which deep contacts separate
};

/// How two geoms push each other apart at their points of contact: as rigid bodies, by stiffness
/// and damping, or by the springs of wheels.
class ContactLaw {
 public:
  /// The geoms touch at that many points.
  ContactLaw(const Geom& a, const Geom& b, std::size_t points, const ContactSettings& settings);

  /// Sets all but the friction of a contact at a point that was found. Overlapping rigid bodies are
  /// separated only if it `pushes`.
  void apply(const PointShare& share, bool pushes, dContact& contact) const;

 private:
  /// m/N, by which the side of one body yields to the other; 0 if it does not.
  double side_yield(const Vec3& normal) const;
  /// m/s, along the normal.
  double parting_speed(const dContactGeom& at) const;
  /// Share of the speed of the bodies towards each other with which they part.
  double bounce(const dContactGeom& at) const;
  void press_wheels(const PointShare& share, dContact& contact) const;
  /// Returns the speed at which they separate, m/s.
  double soften(const PointShare& share, double side, double parts_at, dContact& contact) const;
  void set_min_depth(dContactGeom& at) const;

  const Geom& a_;
  const Geom& b_;
  const ContactSettings& settings_;
  double points_;
  double restitution_;
  double wheels_;  // N/m, of a contact that carries a mechanism with many wheels; 0 if rigid
};

}  // namespace angen::physics
