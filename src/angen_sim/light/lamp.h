#pragma once

#include <memory>

#include "core/id.h"
#include "core/photometry.h"
#include "core/pose.h"

namespace angen::light {

struct LampTag;
using LampId = Id<LampTag>;

struct Lamp {
  enum class Type { kPoint, kSpot, kDirectional, kRectangle, kDisc, kTube };
  Type type = Type::kPoint;
  Pose pose;                                // world; all but point lamps shine along `direction`
  Vec3 direction = -Vec3::UnitZ();          // unit, in its own frame
  double luminous_flux = 800.0;             // lm at level 1 (point: isotropic); directional: lx
  Eigen::Vector3f color{1.0F, 1.0F, 1.0F};  // linear r g b, scaled so that its luminance is 1
  double radius = 0.05;                     // m, of a point's or spot's luminous sphere, disc, tube
  double width = 0.0;       // m, rectangle: along its own x axis (y, where it shines along x)
  double height = 0.0;      // m, rectangle: across
  double length = 0.0;      // m, tube: along its own x axis (y, where it shines along x)
  double half_angle = 0.0;  // rad, spot: from its axis to half the intensity; 0 for the cones below
  double inner_angle = 0.0;                      // rad, spot: full angle of its evenly lit cone
  double outer_angle = 0.0;                      // rad, spot: full angle beyond which it is dark
  std::shared_ptr<const Photometry> photometry;  // a point's or spot's, instead of its own
  double photometric_flux = 0.0;                 // lm, of `photometry`
  bool cast_shadows = true;

  bool flat() const { return type == Type::kRectangle || type == Type::kDisc; }
};

/// A lit lamp, with the share of its flux.
struct Lit {
  Lamp lamp;
  double level = 0.0;
};

}  // namespace angen::light
