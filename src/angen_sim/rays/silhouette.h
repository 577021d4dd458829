#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace angen::rays {

/// Calls visit(outward) with the unit normals of the two lines through the origin of a plane that
/// bound a rectangle, given by its lowest and highest corner; of none if the origin is within it.
template <class Scalar, class Visit>
void each_silhouette(const Eigen::Matrix<Scalar, 2, 1>& low,
                     const Eigen::Matrix<Scalar, 2, 1>& high, const Visit& visit) {
  using Flat = Eigen::Matrix<Scalar, 2, 1>;
  const std::array<Flat, 4> ways = {low, Flat(high.x(), low.y()), high, Flat(low.x(), high.y())};
  for (const Scalar turn : {Scalar{1}, Scalar{-1}}) {
    // Seen from outside, one corner is farthest to that side.
    Flat outward = turn * Flat(-low.y(), low.x());
    for (const Flat& way : ways) {
      if (outward.dot(way) > Scalar{0}) outward = turn * Flat(-way.y(), way.x());
    }
    const bool bounds = outward.squaredNorm() > Scalar{0} &&
                        std::all_of(ways.begin(), ways.end(),
                                    [&](const Flat& way) { return outward.dot(way) <= Scalar{0}; });
    if (bounds) visit(Flat(outward.normalized()));
  }
}

}  // namespace angen::rays
