#include "light/beam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "light/photometry.h"

namespace angen::light {
namespace {

constexpr double kOnSurface = 1e-9;  // m
constexpr std::size_t kSides = 64;   // sides of the polygon that approximates a disc
constexpr std::size_t kArc = 16;     // points of the polygon on an arc of a tube's end

double area_of(const Lamp& lamp) {
  return lamp.type == Lamp::Type::kDisc ? M_PI * lamp.radius * lamp.radius
                                        : lamp.width * lamp.height;
}

/// Candela of a spot: its axial intensity times a power of the cosine, half at its half angle.
double spot_intensity(const Lamp& lamp, double cosine) {
  const double exponent = std::log(0.5) / std::log(std::cos(lamp.half_angle));
  const double ahead = lamp.luminous_flux * (exponent + 1.0) / (2.0 * M_PI);
  return cosine > 0.0 ? ahead * std::pow(cosine, exponent) : 0.0;
}

/// Candela of a spot with cones: constant within the inner cone, then linear in the cosine down to
/// 0 at the outer one; SDF gives both cones' full angles.
double cone_intensity(const Lamp& lamp, double cosine) {
  const double outer = std::cos(std::min(lamp.outer_angle, 2.0 * M_PI) / 2.0);
  const double inner =
      std::max(outer, std::cos(std::min(lamp.inner_angle, lamp.outer_angle) / 2.0));
  if (cosine <= outer) return 0.0;
  const double share = cosine >= inner ? 1.0 : (cosine - outer) / (inner - outer);
  return share * lamp.luminous_flux / (2.0 * M_PI * (1.0 - (inner + outer) / 2.0));
}

double photometric_intensity(const Lamp& lamp, const Vec3& away, double cosine) {
  const Axes axes = axes_of(lamp);
  // LM-63 counts type C counterclockwise as seen from above a luminaire that shines down.
  const double about = std::atan2(-away.dot(axes.across), away.dot(axes.along));
  return intensity(*lamp.photometry, std::acos(std::clamp(cosine, -1.0, 1.0)), about) *
         lamp.luminous_flux / lamp.photometric_flux;
}

/// Candela along `away` (unit, from the lamp). A flat lamp is Lambertian on the
/// side it shines to, a tube's skin all around.
double intensity_along(const Lamp& lamp, const Vec3& away) {
  const double cosine = away.dot(lamp.pose.rotation * lamp.direction);
  if (lamp.flat()) return std::max(0.0, cosine) * lamp.luminous_flux / M_PI;
  if (lamp.photometry) return photometric_intensity(lamp, away, cosine);
  if (lamp.type == Lamp::Type::kTube) {
    return away.cross(axes_of(lamp).along).norm() * lamp.luminous_flux / (M_PI * M_PI);
  }
  if (lamp.type == Lamp::Type::kPoint) return lamp.luminous_flux / (4.0 * M_PI);
  return lamp.half_angle > 0.0 ? spot_intensity(lamp, cosine) : cone_intensity(lamp, cosine);
}

struct Corners {
  std::array<Vec3, kSides + 1> at;  // clipping by a plane adds at most one
  std::size_t count = 0;
};

/// Relative to `point`.
Corners corners_of(const Lamp& lamp, const Vec3& point) {
  const Axes axes = axes_of(lamp);
  const Vec3 middle = lamp.pose.position - point;
  Corners out;
  if (lamp.type == Lamp::Type::kRectangle) {
    const Vec3 half_along = lamp.width / 2 * axes.along;
    const Vec3 half_across = lamp.height / 2 * axes.across;
    for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      out.at[out.count++] = middle + u * half_along + v * half_across;
    }
    return out;
  }
  // A polygon of the disc's area: that of a regular one is n/2 R^2 sin(2 pi/n).
  const double step = 2.0 * M_PI / kSides;
  const double reach = lamp.radius * std::sqrt(step / std::sin(step));
  for (std::size_t i = 0; i < kSides; ++i) {
    const double angle = step * static_cast<double>(i);
    out.at[out.count++] =
        middle + reach * (std::cos(angle) * axes.along + std::sin(angle) * axes.across);
  }
  return out;
}

/// Clips the polygon to the front side of the plane through the origin.
Corners clipped(const Corners& all, const Vec3& normal) {
  Corners out;
  for (std::size_t i = 0; i < all.count; ++i) {
    const Vec3& a = all.at[i];
    const Vec3& b = all.at[(i + 1) % all.count];
    const double before_a = a.dot(normal), before_b = b.dot(normal);
    if (before_a > 0.0) out.at[out.count++] = a;
    if ((before_a > 0.0) != (before_b > 0.0)) {
      out.at[out.count++] = a + before_a / (before_a - before_b) * (b - a);
    }
  }
  return out;
}

/// Lambert 1760: the sum over the edges of the angle each subtends, times the cosine of the edge's
/// plane; for the part of the polygon in front of the plane, at a luminance of 1.
double polygon_illuminance(const Corners& all, const Vec3& normal) {
  const Corners corners = clipped(all, normal);
  if (corners.count < 3) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.count; ++i) {
    const Vec3& a = corners.at[i];
    const Vec3& b = corners.at[(i + 1) % corners.count];
    const Vec3 across = a.cross(b);
    const double length = across.norm();
    if (length < 1e-15) continue;
    sum += std::atan2(length, a.dot(b)) * across.dot(normal) / length;
  }
  return std::abs(sum) / 2.0;
}

double flat_illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal) {
  const Vec3 shines = lamp.pose.rotation * lamp.direction;
  if ((point - lamp.pose.position).dot(shines) <= kOnSurface) return 0.0;
  const double luminance = lamp.luminous_flux / (M_PI * area_of(lamp));
  return luminance * polygon_illuminance(corners_of(lamp, point), normal);
}

/// The skin of a tube that a point sees is bounded by the arcs of both ends that face it and by the
/// two lines where planes through the point touch the skin.
double tube_illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal) {
  const Vec3 along = axes_of(lamp).along;
  const Vec3 middle = lamp.pose.position - point;
  const Vec3 away = middle - middle.dot(along) * along;
  const double distance = away.norm();
  if (distance <= lamp.radius) return 0.0;  // the ends are dark
  const Vec3 facing = -away / distance;
  const Vec3 across = along.cross(facing);
  const double reach = std::acos(lamp.radius / distance);
  Corners seen;
  for (std::size_t i = 0; i < 2 * kArc; ++i) {
    const bool far = i >= kArc;
    const double step = static_cast<double>(far ? 2 * kArc - 1 - i : i) / (kArc - 1);
    const double angle = reach * (2.0 * step - 1.0);
    seen.at[seen.count++] = middle + (far ? 0.5 : -0.5) * lamp.length * along +
                            lamp.radius * (std::cos(angle) * facing + std::sin(angle) * across);
  }
  const double skin = 2.0 * M_PI * lamp.radius * lamp.length;
  return lamp.luminous_flux / (M_PI * skin) * polygon_illuminance(seen, normal);
}

/// A uniform sphere that the plane may cut: J. M. Snyder, Area light sources for real-time graphics
/// (Microsoft Research, 1996).
double globe_illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal) {
  const Vec3 towards = lamp.pose.position - point;
  const double distance = std::max(towards.norm(), lamp.radius);
  const double cosine =
      std::clamp(towards.dot(normal) / std::max(towards.norm(), kOnSurface), -1.0, 1.0);
  const double far = distance / lamp.radius;
  const double skin = lamp.luminous_flux / (4.0 * M_PI * lamp.radius * lamp.radius);  // lm/m^2
  if (far * cosine >= 1.0) return skin * cosine / (far * far);
  if (far * cosine <= -1.0) return 0.0;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const double x = std::sqrt(far * far - 1.0);
  const double y = std::clamp(-x * cosine / sine, -1.0, 1.0);
  const double root = std::sqrt(1.0 - y * y);
  return skin / M_PI *
         ((cosine * std::acos(y) - x * sine * root) / (far * far) + std::atan(sine * root / x));
}

}  // namespace

Axes axes_of(const Lamp& lamp) {
  // Its own x axis unless it shines along that.
  const Vec3 guide = std::abs(lamp.direction.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 across = lamp.direction.cross(guide).normalized();
  return {lamp.pose.rotation * across.cross(lamp.direction), lamp.pose.rotation * across};
}

Beam beam(const Lamp& lamp, const Vec3& point) {
  Beam out;
  if (lamp.type == Lamp::Type::kDirectional) {
    out.towards = -(lamp.pose.rotation * lamp.direction);
    out.distance = std::numeric_limits<double>::infinity();
    out.illuminance = lamp.luminous_flux;
    return out;
  }
  const Vec3 offset = lamp.pose.position - point;
  out.distance = offset.norm();
  if (out.distance < kOnSurface) return out;
  out.towards = offset / out.distance;
  const double clamped = std::max(out.distance, lamp.radius);
  out.illuminance = intensity_along(lamp, -out.towards) / (clamped * clamped);
  return out;
}

double illuminance(const Lamp& lamp, const Vec3& point, const Vec3& normal) {
  if (lamp.flat()) return flat_illuminance(lamp, point, normal);
  if (lamp.type == Lamp::Type::kTube) return tube_illuminance(lamp, point, normal);
  if (lamp.type == Lamp::Type::kPoint && !lamp.photometry && lamp.radius > 0.0) {
    return globe_illuminance(lamp, point, normal);
  }
  const Beam from_lamp = beam(lamp, point);
  return from_lamp.illuminance * std::max(0.0, normal.dot(from_lamp.towards));
}

}  // namespace angen::light
