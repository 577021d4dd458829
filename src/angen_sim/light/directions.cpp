#include "light/directions.h"

#include <cmath>

namespace angen::light {
namespace {

// Points i / g, i / g^2 with g^3 = g + 1: any first few of them are spread evenly (Roberts 2018).
constexpr double kPlastic = 1.3247179572447460;

double fraction(double value) { return value - std::floor(value); }

std::array<std::pair<double, double>, kLampPoints> make_square_points() {
  std::array<std::pair<double, double>, kLampPoints> points;
  for (std::size_t i = 0; i < kLampPoints; ++i) {
    const double k = static_cast<double>(i);
    points[i] = {fraction(0.5 + k / kPlastic), fraction(0.5 + k / (kPlastic * kPlastic))};
  }
  return points;
}

}  // namespace

double radical_inverse(unsigned i) {
  double value = 0.0;
  for (double digit = 0.5; i != 0; i >>= 1, digit /= 2) value += digit * (i & 1U);
  return value;
}

Vec3 cosine_direction(double u, double v) {
  const double radius = std::sqrt(u);
  const double angle = 2.0 * M_PI * v;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1.0 - u)};
}

std::vector<Vec3> cosine_directions(std::size_t count) {
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(cosine_direction((static_cast<double>(i) + 0.5) / static_cast<double>(count),
                                   radical_inverse(static_cast<unsigned>(i))));
  }
  return all;
}

const std::array<std::pair<double, double>, kLampPoints>& square_points() {
  static const auto points = make_square_points();
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
