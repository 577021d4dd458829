#include <algorithm>
#include <set>
#include <vector>

#include "core/lists.h"
#include "rays/scene.h"

namespace angen::rays {

namespace {

constexpr double kPast = 1e-7;  // m beyond a surface, more than the error of its range

/// The surfaces of one shape that are on a line ahead of its origin.
std::vector<Hit> surfaces_on(const Scene& scene, std::uint32_t shape, const Vec3& origin,
                             const Vec3& direction) {
  std::vector<Hit> surfaces;
  Ray ray{origin, direction};
  for (Hit hit = scene.cast_at(shape, ray); hit.hit(); hit = scene.cast_at(shape, ray)) {
    surfaces.push_back(hit);
    ray.min = hit.range + kPast;
  }
  return surfaces;
}

/// Appends the parts of the infinite line from `origin` that are inside one shape.
void add_insides(const Scene& scene, std::uint32_t shape, const Vec3& origin, const Vec3& direction,
                 std::vector<Crossing>& found) {
  const std::vector<Hit> surfaces = surfaces_on(scene, shape, origin, direction);
  if (scene.placement(shape).type == Shape::Type::kPlane) {
    for (const Hit& hit : surfaces) found.push_back({hit.range, hit.range, shape, hit.normal});
    return;
  }
  std::size_t next = 0;
  // Odd, where the line starts inside; or where it touches the shape, and starts outside.
  if (surfaces.size() % 2 == 1 && surfaces_on(scene, shape, origin, -direction).size() % 2 == 1) {
    found.push_back({0.0, surfaces[0].range, shape, surfaces[0].normal});
    next = 1;
  }
  for (; next + 1 < surfaces.size(); next += 2) {
    found.push_back({surfaces[next].range, surfaces[next + 1].range, shape, surfaces[next].normal});
  }
}

}  // namespace

std::vector<Crossing> Scene::crossings(const Vec3& from, const Vec3& to, Mobilities among) const {
  std::vector<Crossing> found;
  const double length = (to - from).norm();
  if (!(length > 0.0)) return found;
  Ray ray{from, (to - from) / length, 0.0, length};
  std::set<std::uint32_t> hit_shapes;
  Hit hit;
  for (cast(&ray, &hit, 1, among); hit.hit(); cast(&ray, &hit, 1, among)) {
    if (hit_shapes.insert(hit.shape).second) {
      add_insides(*this, hit.shape, from, ray.direction, found);
    }
    ray.min = hit.range + kPast;
  }
  erase_if(found, [&](const Crossing& c) { return c.enter > length; });
  for (Crossing& crossing : found) crossing.leave = std::min(crossing.leave, length);
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    return a.enter != b.enter ? a.enter < b.enter : a.shape < b.shape;
  });
  return found;
}

}  // namespace angen::rays
