#include "physics/wheel_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "physics/touching.h"

namespace angen::physics {

namespace {

constexpr double kParallel = 1.0 - 1e-4;   // least cosine between a wheel's axis and its joint's
constexpr double kConcentric = 0.1;        // share of the radius, from the joint's axis
constexpr double kOnMantle = 0.2;          // most cosine between the axis and a point's normal
constexpr double kOneNormal = 1.0 - 1e-6;  // least cosine between normals of one line
constexpr double kShortest = 1e-6;         // m, of a line
constexpr double kEndStiffness = 1e-3;     // stiffness of a point
constexpr double kEndSpring = 0.05;        // spring of a point
// An axis that is corrected by some 1e-6 rad in a step must not press an end.
constexpr double kEndCfm = 1e-4;

bool turns_about_itself(const Geom& geom) {
  const Body& body = *geom.body;
  if (!body.dynamic() || dGeomGetClass(geom.ode.get()) != dCylinderClass) return false;
  dReal radius = 0.0, length = 0.0;
  dGeomCylinderGetParams(geom.ode.get(), &radius, &length);
  const Pose in_model = body.zero * geom.in_body;
  const Vec3 axis = in_model.rotation * Vec3::UnitZ();
  return std::any_of(body.joints.begin(), body.joints.end(), [&](const Joint* joint) {
    if (joint->type != desc::Joint::Type::kRevolute) return false;
    const Vec3& turns = joint->axes[0].in_model;
    return std::abs(turns.dot(axis)) > kParallel &&
           turns.cross(in_model.position - joint->anchor).norm() < kConcentric * radius;
  });
}

bool on_one_line(const dContactGeom& a, const dContactGeom& b) {
  return ode::vec(a.normal).dot(ode::vec(b.normal)) > kOneNormal;
}

dContactGeom middle_of(const dContactGeom& one, const dContactGeom& other) {
  dContactGeom middle = one;
  for (int i = 0; i < 3; ++i) middle.pos[i] = (one.pos[i] + other.pos[i]) / 2.0;
  middle.depth = (one.depth + other.depth) / 2.0;
  return middle;
}

}  // namespace

void mark_wheels(const ModelRecord& record) {
  for (const auto& geom : record.geoms) geom->is_wheel = turns_about_itself(*geom);
}

std::size_t add_middles(const Geom& first, const Geom& second, dContactGeom* points, std::size_t n,
                        PointShare* shares) {
  std::fill_n(shares, n, PointShare{});
  if (!first.is_wheel && !second.is_wheel) return n;
  const Geom& wheel = first.is_wheel ? first : second;
  const Pose at = wheel.body->at * wheel.in_body;
  const Vec3 axis = at.rotation * Vec3::UnitZ();
  const auto along = [&](std::size_t i) { return axis.dot(ode::vec(points[i].pos)); };
  std::array<bool, kMaxPoints> taken{};
  std::size_t count = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (taken[i] || std::abs(axis.dot(ode::vec(points[i].normal))) > kOnMantle) continue;
    std::vector<std::size_t> line;
    for (std::size_t k = i; k < n; ++k) {
      if (!taken[k] && on_one_line(points[i], points[k])) line.push_back(k);
    }
    for (const std::size_t k : line) taken[k] = true;
    const auto [low, high] = std::minmax_element(
        line.begin(), line.end(), [&](auto a, auto b) { return along(a) < along(b); });
    if (along(*high) - along(*low) < kShortest) continue;
    const auto ends = static_cast<double>(line.size());
    points[count] = middle_of(points[*low], points[*high]);
    for (const std::size_t k : line)
      shares[k] = {kEndStiffness, kEndCfm, 0.0, kEndSpring, points[count].depth};
    shares[count++] = {ends, 0.0, 1.0};
  }
  return count;
}

}  // namespace angen::physics
