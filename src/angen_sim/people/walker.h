#pragma once

#include <optional>

#include "people/braking.h"
#include "people/surroundings.h"
#include "plugin/plugin.h"
#include "plugin/wiring.h"

namespace angen::people {

constexpr double kReturnSpeed = 0.8;  // m/s, back to a path that it was pushed off, and at doors

/// A person's eyes and legs: it looks around ten times a second, and walks by a motor of limited
/// force, slower before obstacles and round them.
class Walker {
 public:
  using Vec2 = Surroundings::Vec2;

  struct Manner {
    bool looks = true;    // for obstacles, and stops before them
    bool rounds = true;   // walks round them
    bool pushes = false;  // walks on slowly, and pushes them
  };
  enum class Look { kNone, kSees, kPlans };

  Walker() = default;
  /// `force_max` in N.
  Walker(LinkRef link, double force_max) : link_(link), force_max_(force_max) {}

  void behave(const Manner& manner) { manner_ = manner; }
  const Manner& manner() const { return manner_; }
  /// Once in each update, before the rest.
  void begin(Nanoseconds step);

  /// Looks around if it is time for it. With each third look a way round is planned.
  Look look(const View& view, const Vec3& feet);
  /// Looks where the floor ends, if it is time for it: who pushes walks on over all but that.
  void look_down(const View& view, const Vec3& feet);
  /// Looks at once the next time.
  void look_anew() { looked_at_ = looked_down_at_ = -1; }
  /// Looks around now, apart from the usual looks.
  const Surroundings& scan(const View& view, const Vec3& feet);
  const Surroundings& surroundings() const { return surroundings_; }

  /// Makes for a place straight …
  void aim_straight() { aim_.reset(); }
  /// … or round what is on the straight way, if it sees a way.
  void aim_for(const View& view, const Vec3& feet, const Vec2& to);
  /// Makes for a way round something on the way; returns whether it sees one.
  bool aim_past(const View& view, const Vec3& feet, const Vec2& to);
  bool goes_round() const { return aim_.has_value(); }
  /// Where it can go no farther, it walks along what is nearest to it.
  void slide(bool slides) { slides_ = slides; }

  /// Walks towards a place, or to the first one of the way round, at most that fast (m/s), and
  /// turns by `turn` (rad); by default it faces the way.
  void walk(const LinkView& body, const Vec2& to, double fastest, Outputs& outputs,
            std::optional<double> turn = {});
  /// Stands, and turns to a direction.
  void face(const LinkView& body, const Vec2& direction, Outputs& outputs);
  void stand(Outputs& outputs);
  bool rests() const { return rests_; }

 private:
  std::optional<Vec2> way_past(const View& view, const Vec3& feet, const Vec2& to) const;
  Vec2 velocity(const LinkView& body, const Vec2& to, double fastest);
  double limit_of_run(const LinkView& body);
  Vec2 slid(const Vec2& at, const Vec2& direction) const;
  void drive(const Vec2& velocity, double turn, Outputs& outputs);

  LinkRef link_;
  double force_max_ = 0.0;  // N
  Manner manner_;
  Surroundings surroundings_;
  Braking braking_;
  Braking run_braking_;  // along the way that it moves
  Surroundings floor_;   // its ends
  Braking floor_braking_;
  std::optional<Vec2> aim_;     // the first place of a way round
  Nanoseconds looked_at_ = -1;  // the last look, as a multiple of kScanPeriod
  Nanoseconds looked_down_at_ = -1;
  double late_ = 0.0;  // s: the mean age of its velocity in longer steps
  bool slides_ = false;
  bool runs_ = false;
  bool rests_ = false;
};

}  // namespace angen::people
