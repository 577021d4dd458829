#pragma once

#include <optional>
#include <string>

#include "people/errand.h"
#include "people/surroundings.h"
#include "plugin/plugin.h"

namespace angen::people {

/// A person's way to another floor: to the landing of an elevator, which it calls by a command as
/// anybody does, into the cabin, up or down, and out.
class Ride {
 public:
  using Vec2 = Surroundings::Vec2;

  /// By the first elevator that serves both floors; none if there is none. `goal` (world, m) is
  /// where the person wants to go there.
  static std::optional<Ride> between(const Home& home, int from, int to, const Vec2& goal);

  /// Where it begins (m, world): in the cabin it rides on.
  void start_at(const Vec2& at, Nanoseconds now);

  struct Advice {
    enum class Step { kWalk, kStand, kLeft, kFailed } step = Step::kStand;
    Vec2 to = Vec2::Zero();  // where it walks next, for kWalk and kLeft
    std::string why = {};    // the reason, for kFailed
  };
  /// The next step; `errand` is the walk of the last one.
  Advice update(const View& view, const Errand& errand, Outputs& outputs);
  const Vec2& goal() const { return goal_; }
  int floor() const { return to_.floor; }

 private:
  enum class Phase { kToLanding, kCalls, kBoards, kRides, kLeaves };
  struct Stop {
    int floor = 0;    // the storey's number
    int number = 0;   // the elevator's, of commands
    Vec2 wait{0, 0};  // m, on the landing
  };

  void enter(Phase phase, Nanoseconds now);
  const Reading* state(const View& view) const;
  Advice wait_for(const Stop& stop, const Vec2& then, Phase next, const View& view,
                  Outputs& outputs);

  std::string elevator_;
  Stop from_;
  Stop to_;
  Vec2 cabin_ = Vec2::Zero();
  Vec2 goal_ = Vec2::Zero();
  Phase phase_ = Phase::kToLanding;
  Nanoseconds since_ = 0;       // the beginning of this phase
  Nanoseconds called_at_ = -1;  // when it last called
  bool begun_ = false;
  int tries_ = 0;
};

}  // namespace angen::people
