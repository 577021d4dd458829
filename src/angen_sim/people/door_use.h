#pragma once

#include <optional>
#include <string>
#include <vector>

#include "people/surroundings.h"
#include "plugin/plugin.h"

namespace angen::people {

/// A door between two rooms, as a person sees it.
struct DoorSeen {
  using Vec2 = Surroundings::Vec2;

  std::string name;
  std::string model;
  std::string mode;
  Vec2 hinge = Vec2::Zero();   // m
  Vec2 along = Vec2::UnitX();  // unit, from the hinge along the shut leaf
  Vec2 into = Vec2::UnitY();   // unit, towards the side that the leaf opens to
  double width = 0.0;          // m
  double gap = 0.0;            // m, free width
  bool slides = false;         // to neither side
  Vec2 open = Vec2::UnitY();   // unit, from the hinge along the open leaf; unless it slides
  std::string partner;         // the other leaf of a double door, where one alone is narrow
  std::string partner_mode;

  Vec2 edge() const { return hinge + width * along; }
  /// Whether its leaf stands open, and turned.
  bool is_open() const { return !slides && mode == "OPEN"; }
  /// m to its open leaf, if that is in sight and leaves a person no straight way.
  std::optional<double> way_to_leaf(const Vec2& at, const Vec2& to) const;
  /// Whether a person fits through.
  bool is_passable() const;
  /// Whether a point is on the open leaf.
  bool has_on_leaf(const Vec2& point) const;
  /// Whether a point is on the shut leaf, or behind it as seen from a place.
  bool hides(const Vec2& point, const Vec2& from) const;
};

/// The doors of a storey whose floor is at `z`.
std::vector<DoorSeen> doors_seen(const View& view, double z);
enum class Passable { kNo, kYes };
/// The door nearest to `at` that is on the straight way: a shut one, or one that a person fits
/// through.
std::optional<DoorSeen> door_on_way(const std::vector<DoorSeen>& doors,
                                    const Surroundings::Vec2& at, const Surroundings::Vec2& to,
                                    Passable passable = Passable::kNo);

/// Places from which a person at `feet` can shut an open leaf, the nearest first: on the side that
/// it opens to, and out of its swing. None if another or a robot is in that.
std::vector<Surroundings::Vec2> places_to_shut(const View& view, const Vec3& feet,
                                               const DoorSeen& door);

/// Where a person at `feet` walks on the straight way to a place: up to a shut door, or all of it.
Surroundings::Vec2 up_to_door(const View& view, const Vec3& feet, const Surroundings::Vec2& to);

/// Takes a person through shut doors: it walks to the handle, opens the door by hand, out of the
/// leaf's way, walks through, and may close it, as it may close one that was open. It always closes
/// one whose leaf closes off a corridor. Of a double door it opens both leaves where one leaves too
/// little room. It turns no leaf against a robot.
class DoorUse {
 public:
  using Vec2 = Surroundings::Vec2;

  struct Advice {
    // kWait: until another opens the door; kFailed: it cannot open the door, as this step showed.
    enum class Step { kWalk, kGo, kStand, kWait, kFailed } step = Step::kWalk;
    Vec2 to = Vec2::Zero();  // destination of kGo; otherwise the point that it looks at
  };

  DoorUse() = default;
  DoorUse(bool opens, bool closes) : opens_(opens), closes_(closes) {}

  /// The next step of a person at `feet` (world, m) who makes for the first of some places,
  /// or around a corner for the others. Looks for doors if there are any. Commands doors.
  Advice update(const View& view, const Vec3& feet, const std::vector<Vec2>& places,
                Outputs& outputs);
  void reset() { phase_ = Phase::kNone; }
  /// Shuts open doors nearby that nobody is at, of a model or of all: their leaves may close off
  /// its way. Returns whether there are any.
  bool shut_nearby(const View& view, const Vec3& feet, Outputs& outputs,
                   const std::string& model = "") const;
  /// Makes for a place from which it shuts an open leaf, and shuts it.
  void go_and_shut(const DoorSeen& door, const Vec2& place, Nanoseconds now);
  /// Waits until a leaf nearby is shut that just swings to; returns whether there is one.
  bool wait_for_leaf(const View& view, const Vec3& feet);
  /// Whether it shuts the doors that it walks through.
  void close(bool closes) { closes_ = closes; }
  bool closes() const { return closes_; }
  /// It is about to open or to shut a door.
  bool is_busy() const { return phase_ != Phase::kNone && phase_ != Phase::kPassing; }
  /// The door that it is at.
  const DoorSeen& door() const { return door_; }
  /// Why that did not open.
  const std::string& why() const { return why_; }

 private:
  enum class Phase { kNone, kApproach, kOpening, kWaiting, kPassing, kToLeaf, kClosing };

  void look(const View& view, const Vec3& feet, const std::vector<Vec2>& places);
  Advice approach(const View& view, const Vec3& feet, Outputs& outputs);
  Advice open(const View& view, const Vec3& feet, Outputs& outputs);
  Advice wait_until_open(const View& view, const Vec3& feet);
  Advice fail(const View& view, const Vec3& feet, const std::string& why);
  Advice pass(const View& view, const Vec3& feet, Outputs& outputs);
  Advice shut(const View& view, const Vec3& feet, Outputs& outputs);
  bool closes_off(const View& view, const Vec3& feet) const;
  bool is_in_swing(const Vec2& at) const;
  bool moves() const { return door_.mode == "OPENING" || door_.partner_mode == "OPENING"; }
  /// Whether its leaf opens to the side of the person.
  bool pulls() const { return !door_.slides && side_ > 0.0; }
  Vec2 handle() const;
  /// The person's place to open the door.
  Vec2 free_spot(const View& view, const Vec3& feet) const;
  /// The free one of spots().
  Vec2 pull_spot(const View& view, const Vec3& feet) const;
  /// The places from which it can pull, the best first.
  std::vector<Vec2> spots() const;
  bool refresh(const View& view, double z);
  void enter(Phase phase, Nanoseconds now);

  bool opens_ = true;
  bool closes_ = false;
  Phase phase_ = Phase::kNone;
  DoorSeen door_;
  Nanoseconds refreshed_ = 0;
  Vec2 spot_ = Vec2::Zero();
  std::optional<Vec2> missed_;      // the spot that it did not get to
  double side_ = 1.0;               // where it came from: 1 = the side that the leaf opens to
  Nanoseconds since_ = 0;           // start of this phase
  std::optional<bool> closes_off_;  // while passing: whether nobody gets past the open leaf
  int failures_ = 0;                // one after the other
  std::string why_;
  Nanoseconds tries_at_ = 0;  // again, after those
};

}  // namespace angen::people
