#include "light/directions.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "core/random.h"

namespace angen::light {
namespace {

/// Van der Corput's sequence: the bits of i behind the binary point, last bit first.
double radical_inverse(unsigned i) {
  double value = 0.0;
  for (double digit = 0.5; i != 0; i >>= 1, digit /= 2) value += digit * (i & 1U);
  return value;
}

/// Malley's way: a disc filled evenly, lifted onto the hemisphere.
Vec3 cosine_weighted(double u, double v) {
  const double radius = std::sqrt(u);
  const double angle = 2.0 * M_PI * v;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - u)};
}

Directions make_directions() {
  Directions all;
  for (int bounce = 0; bounce < kBounces; ++bounce) {
    // Each bounce hands out the same even set in another order, so that bounces are independent.
    std::array<unsigned, kPaths> order;
    std::iota(order.begin(), order.end(), 0U);
    Rng rng(0, hash_bytes("light directions"), bounce);
    for (std::size_t i = kPaths - 1; i > 0; --i) std::swap(order[i], order[rng.next() % (i + 1)]);
    for (std::size_t i = 0; i < kPaths; ++i) {
      all[static_cast<std::size_t>(bounce)][i] =
          cosine_weighted((order[i] + 0.5) / kPaths, radical_inverse(order[i]));
    }
  }
  return all;
}

std::array<Vec3, kLampPoints> make_lamp_points() {
  std::array<Vec3, kLampPoints> points;
  const double golden = M_PI * (3.0 - std::sqrt(5.0));
  for (std::size_t i = 0; i < kLampPoints; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / kLampPoints;
    const double angle = golden * static_cast<double>(i);
    const double around = std::sqrt(1.0 - z * z);
    points[i] = {around * std::cos(angle), around * std::sin(angle), z};
  }
  return points;
}

}  // namespace

const Directions& directions() {
  static const Directions all = make_directions();
  return all;
}

const std::array<Vec3, kLampPoints>& lamp_points() {
  static const std::array<Vec3, kLampPoints> points = make_lamp_points();
  return points;
}

// Duff et al. 2017, "Building an orthonormal basis, revisited".
Eigen::Matrix3d frame_about(const Vec3& normal) {
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1.0 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  Eigen::Matrix3d frame;
  frame.col(0) = Vec3(1.0 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  frame.col(1) = Vec3(b, sign + normal.y() * normal.y() * a, -normal.y());
  frame.col(2) = normal;
  return frame;
}

}  // namespace angen::light
