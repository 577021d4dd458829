#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "core/time.h"
#include "rays/scene.h"

namespace angen::sim {

/// The resting loose bodies: those that have not moved for 5 s, or since the start. Light treats
/// their shapes as standing.
class Resting {
 public:
  using Body = std::uint32_t;
  static constexpr Body kNone = UINT32_MAX;

  /// Adds a body at rest.
  Body add(const Pose& pose);
  void add_shape(Body body, rays::ShapeId shape) { bodies_[body].shapes.push_back(shape); }
  void remove(Body body);

  bool rests(Body body) const { return bodies_[body].still; }
  /// Records the present pose. True if it was resting until now.
  bool move(Body body, const Pose& pose);
  /// Calls visit(body) for those that begin to rest. To be called once a tick.
  template <class F>
  void update(Nanoseconds now, F&& visit) {
    for (std::size_t i = 0; i < moving_.size();) {
      const Body body = moving_[i];
      if (!come_to_rest(bodies_[body], now)) {
        ++i;
        continue;
      }
      moving_.erase(moving_.begin() + static_cast<std::ptrdiff_t>(i));
      visit(body);
    }
  }
  /// When the next one will, if it does not move; kForever if all do. After update().
  Nanoseconds next() const;
  const std::vector<rays::ShapeId>& shapes(Body body) const { return bodies_[body].shapes; }

 private:
  struct State {
    std::vector<rays::ShapeId> shapes;
    Pose pose;              // from which it has not moved noticeably
    bool still = true;      // for long enough
    bool moved = false;     // since the last update()
    Nanoseconds since = 0;  // it has that pose
  };
  static bool come_to_rest(State& state, Nanoseconds now);

  std::vector<State> bodies_;
  std::vector<Body> moving_;
  std::vector<Body> free_;
};

}  // namespace angen::sim
