#include "core/polygon.h"

#include <algorithm>
#include <limits>

namespace angen {

namespace {

double cross(const Point2& a, const Point2& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_to(const Point2& point, const Point2& from, const Point2& to) {
  const Point2 along = to - from;
  const double length = along.squaredNorm();
  const double share =
      length > 0.0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

bool on_segment(const Point2& point, const Point2& from, const Point2& to) {
  constexpr double kTouch = 1e-9;  // m
  return distance_to(point, from, to) < kTouch;
}

bool cut(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return true;
  return on_segment(a, c, d) || on_segment(b, c, d) || on_segment(c, a, b) || on_segment(d, a, b);
}

}  // namespace

double signed_area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    // From the first corner: coordinates far from the origin lose no digits.
    twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return 0.5 * twice;
}

bool contains(const Polygon& polygon, const Point2& point) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2& a = polygon[i];
    const Point2& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (point.x() < x) inside = !inside;
  }
  return inside;
}

double distance_to_edge(const Polygon& polygon, const Point2& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    nearest = std::min(nearest, distance_to(point, polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return nearest;
}

std::optional<std::array<std::size_t, 2>> crossing_edges(const Polygon& polygon) {
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Point2& a = polygon[i];
    const Point2& b = polygon[(i + 1) % count];
    for (std::size_t j = i + 1; j < count; ++j) {
      const Point2& c = polygon[j];
      const Point2& d = polygon[(j + 1) % count];
      const bool before = j == i + 1;
      const bool after = (j + 1) % count == i;
      if (before && after) continue;
      // Neighbors share a corner; they must not fold back over each other.
      const bool meet = before  ? on_segment(d, a, b) || on_segment(a, c, d)
                        : after ? on_segment(c, a, b) || on_segment(b, c, d)
                                : cut(a, b, c, d);
      if (meet) return {{i, j}};
    }
  }
  return std::nullopt;
}

}  // namespace angen
