#include "physics/reduce.h"

#include <algorithm>

namespace angen::physics {

namespace {

constexpr double kSamePlace = 1e-5;  // m
constexpr double kSameNormal = 0.99;

bool same(const dContactGeom& a, const dContactGeom& b) {
  return (ode::vec(a.pos) - ode::vec(b.pos)).norm() < kSamePlace &&
         ode::vec(a.normal).dot(ode::vec(b.normal)) > kSameNormal;
}

bool one_above_the_other(const dContactGeom& a, const dContactGeom& b) {
  return (ode::vec(a.pos) - ode::vec(b.pos)).head<2>().norm() < kSamePlace &&
         ode::vec(a.normal).dot(ode::vec(b.normal)) > kSameNormal;
}

// Keeps the deeper one of two points that are `twins`.
template <class Twins>
std::size_t remove_doubles(dContactGeom* points, std::size_t n, Twins&& twins) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    dContactGeom* twin = std::find_if(points, points + kept,
                                      [&](const dContactGeom& p) { return twins(p, points[i]); });
    if (twin == points + kept) {
      points[kept++] = points[i];
    } else if (points[i].depth > twin->depth) {
      *twin = points[i];
    }
  }
  return kept;
}

}  // namespace

std::size_t reduce_upright(dContactGeom* points, std::size_t n) {
  return remove_doubles(points, n, one_above_the_other);
}

std::size_t reduce_points(dContactGeom* points, std::size_t n) {
  n = remove_doubles(points, n, same);
  if (n <= kMaxPoints) return n;
  std::iter_swap(points, std::max_element(points, points + n, [](const auto& a, const auto& b) {
                   return a.depth < b.depth;
                 }));
  for (std::size_t kept = 1; kept < kMaxPoints; ++kept) {
    std::size_t best = kept;
    double best_distance = -1.0;
    for (std::size_t i = kept; i < n; ++i) {
      double nearest = dInfinity;
      for (std::size_t k = 0; k < kept; ++k) {
        nearest = std::min(nearest, (ode::vec(points[i].pos) - ode::vec(points[k].pos)).norm());
      }
      if (nearest > best_distance) {
        best_distance = nearest;
        best = i;
      }
    }
    std::swap(points[kept], points[best]);
  }
  return kMaxPoints;
}

}  // namespace angen::physics
