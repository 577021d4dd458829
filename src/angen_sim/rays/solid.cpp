#include "rays/solid.h"

#include <cmath>

namespace angen::rays {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The part of a ray inside a convex solid, and the face at either end.
struct Span {
  double enter = -kInfinity;
  double leave = kInfinity;
  std::uint32_t enter_feature = 0;
  std::uint32_t leave_feature = 0;

  bool empty() const { return !(enter <= leave); }

  void clip(double from, double to, std::uint32_t feature) {
    if (from > enter) {
      enter = from;
      enter_feature = feature;
    }
    if (to < leave) {
      leave = to;
      leave_feature = feature;
    }
  }
  void miss() {
    enter = kInfinity;
    leave = -kInfinity;
  }
};

struct LocalRay {
  Vec3 origin, direction;
};

LocalRay to_local(const Solid& solid, const Vec3& origin, const Vec3& direction) {
  const Vec3 offset = origin - solid.position;
  if (solid.aligned) return {offset, direction};
  return {solid.rotation.transpose() * offset, solid.rotation.transpose() * direction};
}

void clip_slab(Span& span, double origin, double direction, double half, std::uint32_t feature) {
  if (std::abs(direction) < 1e-300) {
    if (std::abs(origin) > half) span.miss();
    return;
  }
  const double inverse = 1.0 / direction;
  const double low = (-half - origin) * inverse;
  const double high = (half - origin) * inverse;
  span.clip(std::min(low, high), std::max(low, high), feature);
}

Span box_span(const Solid& solid, const LocalRay& ray) {
  Span span;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    clip_slab(span, ray.origin[axis], ray.direction[axis], solid.half[axis], axis);
  }
  return span;
}

/// Sphere or infinite cylinder. Starts from the point nearest to the center, which is accurate far
/// away.
template <int kDimensions>
Span round_span(const Eigen::Matrix<double, kDimensions, 1>& origin,
                const Eigen::Matrix<double, kDimensions, 1>& direction, double radius) {
  Span span;
  const double length2 = direction.squaredNorm();
  if (length2 < 1e-300) {
    if (origin.squaredNorm() > radius * radius) span.miss();
    return span;
  }
  const double middle = -origin.dot(direction) / length2;
  const double inside = radius * radius - (origin + middle * direction).squaredNorm();
  if (!(inside >= 0.0)) {
    span.miss();
    return span;
  }
  const double half_chord = std::sqrt(inside / length2);
  span.clip(middle - half_chord, middle + half_chord, 0);
  return span;
}

Span cylinder_span(const Solid& solid, const LocalRay& ray) {
  Span span = round_span<2>(ray.origin.head<2>(), ray.direction.head<2>(), solid.radius);
  clip_slab(span, ray.origin.z(), ray.direction.z(), solid.half.z(), 1);
  return span;
}

/// A capsule is convex and the union of a cylinder and two balls, so the outermost ends are its
/// own.
Span capsule_span(const Solid& solid, const LocalRay& ray) {
  Span whole;
  whole.miss();
  const auto unite = [&whole](const Span& part) {
    if (part.empty()) return;
    whole.enter = std::min(whole.enter, part.enter);
    whole.leave = std::max(whole.leave, part.leave);
  };
  unite(cylinder_span(solid, ray));
  for (const double side : {-1.0, 1.0}) {
    const Vec3 from_centre = ray.origin - Vec3(0, 0, side * solid.half.z());
    unite(round_span<3>(from_centre, ray.direction, solid.radius));
  }
  return whole;
}

Span span_of(const Solid& solid, const LocalRay& ray) {
  switch (solid.type) {
    case Shape::Type::kBox:
      return box_span(solid, ray);
    case Shape::Type::kSphere:
      return round_span<3>(ray.origin, ray.direction, solid.radius);
    case Shape::Type::kCylinder:
      return cylinder_span(solid, ray);
    case Shape::Type::kCapsule:
      return capsule_span(solid, ray);
    default: {
      Span none;
      none.miss();
      return none;
    }
  }
}

bool within(double range, double min, double max) { return range >= min && range <= max; }

/// Half extents of the solid's box in the world; false if its sizes are invalid.
bool half_extent(const Solid& solid, Vec3& extent) {
  const Vec3 axis = solid.rotation.col(2).cwiseAbs();
  switch (solid.type) {
    case Shape::Type::kBox:
      extent = solid.rotation.cwiseAbs() * solid.half;
      return (solid.half.array() >= 0.0).all();
    case Shape::Type::kSphere:
      extent = Vec3::Constant(solid.radius);
      return solid.radius >= 0.0;
    case Shape::Type::kCylinder: {
      const Vec3 disc = (1.0 - axis.array().square()).max(0.0).sqrt() * solid.radius;
      extent = axis * solid.half.z() + disc;
      return solid.radius >= 0.0 && solid.half.z() >= 0.0;
    }
    case Shape::Type::kCapsule:
      extent = axis * solid.half.z() + Vec3::Constant(solid.radius);
      return solid.radius >= 0.0 && solid.half.z() >= 0.0;
    default:
      return false;
  }
}

Eigen::AlignedBox3d bounds_of(const Solid& solid) {
  if (!solid.position.allFinite() || !solid.rotation.allFinite()) return {};
  if (solid.type == Shape::Type::kMesh) {
    if (!solid.mesh || solid.mesh->bounds().isEmpty()) return {};
    const Vec3 half = solid.mesh->bounds().sizes() / 2;
    const Vec3 center = solid.position + solid.rotation * solid.mesh->bounds().center();
    const Vec3 extent = solid.rotation.cwiseAbs() * half;
    return {center - extent, center + extent};
  }
  Vec3 extent;
  if (!half_extent(solid, extent) || !extent.allFinite()) return {};
  return {solid.position - extent, solid.position + extent};
}

}  // namespace

void Solid::place(const Pose& pose) {
  position = pose.position;
  rotation = pose.rotation.normalized().toRotationMatrix();
  aligned = rotation == Eigen::Matrix3d::Identity();
  box = bounds_of(*this);
}

Eigen::AlignedBox3d own_box(const Solid& solid) {
  if (solid.type == Shape::Type::kMesh) {
    return solid.mesh ? solid.mesh->bounds() : Eigen::AlignedBox3d{};
  }
  if (solid.type == Shape::Type::kPlane) {
    return {Vec3(-kInfinity, -kInfinity, 0.0), Vec3(kInfinity, kInfinity, 0.0)};
  }
  Solid upright = solid;
  upright.place({});
  return upright.box;
}

bool contains(const Solid& solid, const Vec3& point) {
  const Vec3 local = solid.rotation.transpose() * (point - solid.position);
  const double above = std::max(0.0, std::abs(local.z()) - solid.half.z());
  const double round = solid.radius + kSkin;
  switch (solid.type) {
    case Shape::Type::kBox:
      return (local.cwiseAbs().array() <= solid.half.array() + kSkin).all();
    case Shape::Type::kSphere:
      return local.squaredNorm() <= round * round;
    case Shape::Type::kCylinder:
      return above <= kSkin && local.head<2>().squaredNorm() <= round * round;
    case Shape::Type::kCapsule:
      return local.head<2>().squaredNorm() + above * above <= round * round;
    default:
      return false;
  }
}

bool find_hit(const Solid& solid, const Vec3& origin, const Vec3& direction, double min, double max,
              Intersection& out) {
  const LocalRay ray = to_local(solid, origin, direction);
  if (solid.type == Shape::Type::kMesh) {
    return solid.mesh->find_hit(ray.origin, ray.direction, min, max, out.range, out.feature);
  }
  if (solid.type == Shape::Type::kPlane) {
    out = {-ray.origin.z() / ray.direction.z(), 0};
    return std::isfinite(out.range) && within(out.range, min, max);
  }
  const Span span = span_of(solid, ray);
  if (span.empty()) return false;
  out = span.enter >= min ? Intersection{span.enter, span.enter_feature}
                          : Intersection{span.leave, span.leave_feature};
  return std::isfinite(out.range) && within(out.range, min, max);
}

Vec3 normal_at(const Solid& solid, const Vec3& origin, const Vec3& direction,
               const Intersection& hit) {
  const LocalRay ray = to_local(solid, origin, direction);
  const Vec3 point = ray.origin + hit.range * ray.direction;
  Vec3 normal = Vec3::UnitZ();
  switch (solid.type) {
    case Shape::Type::kBox:
      normal = Vec3::Unit(hit.feature);
      break;
    case Shape::Type::kSphere:
      normal = point.normalized();
      break;
    case Shape::Type::kCylinder:
      if (hit.feature == 0) normal = Vec3(point.x(), point.y(), 0).normalized();
      break;
    case Shape::Type::kCapsule: {
      const double along = std::max(-solid.half.z(), std::min(solid.half.z(), point.z()));
      normal = (point - Vec3(0, 0, along)).normalized();
      break;
    }
    case Shape::Type::kMesh:
      normal = solid.mesh->normal(hit.feature);
      break;
    default:
      break;
  }
  if (normal.dot(ray.direction) > 0) normal = -normal;
  return solid.rotation * normal;
}

}  // namespace angen::rays
