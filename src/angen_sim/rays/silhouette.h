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
  int found = 0;  // a flat rectangle has the same line twice
  for (const Flat& way : ways) {
    for (const Scalar turn : {Scalar{1}, Scalar{-1}}) {
      const Flat outward = turn * Flat(-way.y(), way.x());
      const bool bounds = found < 4 && outward.squaredNorm() > Scalar{0} &&
                          std::all_of(ways.begin(), ways.end(),
                                      [&](const Flat& w) { return outward.dot(w) <= Scalar{0}; });
      if (!bounds) continue;
      visit(Flat(outward.normalized()));
      ++found;
    }
  }
}

}  // namespace angen::rays
