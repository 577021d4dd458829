#pragma once

#include <vector>

#include "people/floor_map.h"

namespace angen::people {

/// A way on a map, and how far a person has come on it.
class Route {
 public:
  using Vec2 = FloorMap::Vec2;

  Route() = default;
  Route(FloorMap map, std::vector<Vec2> way);

  /// Notes where the person is. Returns the place to make for: straight ahead on the way, or where
  /// the way bends.
  Vec2 follow(const Vec2& at);
  /// The places of the way from the person on, for 0.8 m or more.
  std::vector<Vec2> next() const;
  /// m of the way from `at`.
  double left(const Vec2& at) const;

 private:
  FloorMap map_;
  std::vector<Vec2> way_;
  std::vector<double> left_;  // m from each place of the way to its end
  std::size_t next_ = 0;      // the place of the way nearest to the person
};

}  // namespace angen::people
