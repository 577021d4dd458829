#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace angen {

using Point2 = Eigen::Vector2d;
using Polygon = std::vector<Point2>;  // m; the last corner is joined to the first

/// m^2, positive where the corners are counterclockwise.
double signed_area(const Polygon& polygon);
/// Whether a point is inside; of one on an edge either.
bool contains(const Polygon& polygon, const Point2& point);
/// m from a point to the nearest edge.
double distance_to_edge(const Polygon& polygon, const Point2& point);
/// The numbers of two edges that meet elsewhere than at a corner that they share: edge i is from
/// corner i to the next. None for a simple polygon.
std::optional<std::array<std::size_t, 2>> crossing_edges(const Polygon& polygon);

}  // namespace angen
