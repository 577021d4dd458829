#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "people/door_use.h"
#include "people/right_of_way.h"
#include "people/route.h"
#include "people/storey_maps.h"
#include "people/surroundings.h"

namespace angen::people {

/// Plans a person's way to a goal on its storey: straight over free floor, or on a map of what
/// cannot move, with the obstacles that it has seen on the way there.
class Navigator {
 public:
  using Vec2 = Surroundings::Vec2;

  /// An open leaf that leaves no way, and a place to shut it from.
  struct LeafInWay {
    DoorSeen door;
    Vec2 place;  // m
  };

  Navigator() = default;
  /// Whether the person opens doors.
  Navigator(std::shared_ptr<StoreyMaps> maps, bool opens_doors)
      : maps_(std::move(maps)), opens_doors_(opens_doors) {}

  /// Another goal: what it has seen on the way to the last one counts no more.
  void forget();
  /// A way for a person at `feet` (world, m); `with_seen`: past the obstacles that it has seen,
  /// too. False if no way leads there.
  bool plan(const View& view, const Vec3& feet, const Vec2& to, bool with_seen);
  /// Straight to the goal, through what is there.
  void go_straight() { route_.reset(); }

  /// The place to make for on the way, kept until the next call.
  const Vec2& advance(const Vec2& at, const Vec2& to);
  const std::optional<Vec2>& target() const { return target_; }
  /// The place to make for, and after it those that are next on the way.
  std::vector<Vec2> ahead() const;
  void drop_target() { target_.reset(); }
  /// m of the way to the goal.
  double left(const Vec2& at, const Vec2& to) const;

  /// Adds the points that it sees to those that it knows, and removes those that are gone.
  void learn(const View& view, const Vec3& feet, const Surroundings& seen);
  void note_obstacle(const Vec2& point) { seen_.push_back(point); }
  /// A door that does not open is a wall until the goal changes.
  void note_failed(const DoorSeen& door, std::string why);
  /// The leaf without which a way would lead past what it has seen, if it can shut that.
  std::optional<LeafInWay> leaf_in_way(const View& view, const Vec3& feet, const Vec2& to) const;
  /// What it has seen of an open leaf counts no more.
  void forget_leaf(const DoorSeen& door);
  /// The model that can move and is the first on the way that leads to the goal without what it has
  /// seen; empty if that is none.
  std::string what_blocks(const View& view, const Vec3& feet, const Vec2& to) const;
  /// Why plan() found no way for a person at `feet`.
  std::string why_not(const View& view, const Vec3& feet, const Vec2& to) const;
  /// The narrow parts of the way, between what cannot move.
  const std::vector<Passage>& passages() const { return passages_; }
  bool knows_obstacles() const { return !seen_.empty(); }

 private:
  /// A map of the storey, with points that it has seen and tolls of the doors that are shut.
  FloorMap map_with(const View& view, const Vec3& feet, const Vec2& to,
                    const std::vector<Vec2>& points) const;
  bool is_in_passage(const Vec2& at) const;
  void add_passage_behind(const FloorMap& map, std::vector<Vec2> way);
  void add_line(const Vec2& from, const Vec2& along, double length);

  std::shared_ptr<StoreyMaps> maps_;
  bool opens_doors_ = true;
  std::optional<Route> route_;  // none: straight
  std::vector<Vec2> seen_;
  std::vector<std::string> failed_;
  std::string why_failed_;  // the last of these
  std::vector<Passage> passages_;
  std::optional<Vec2> target_;
};

}  // namespace angen::people
