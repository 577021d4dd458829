#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "plugin/plugin.h"

namespace angen::people {

/// A person's surroundings: surfaces between shin and chest height, up to kSight away, and where
/// the floor ends. Hidden places count as free, and so do slopes that a person walks up.
class Surroundings {
 public:
  using Vec2 = Eigen::Vector2d;

  static constexpr double kSight = 3.0;  // m
  static constexpr double kBody = 0.26;  // m, half a person's width and a centimeter

  /// Casts rays from a body at `feet` (world, m). Keeps the hits of the scan before.
  void scan(const View& view, const Vec3& feet);

  /// Sees only where the floor ends, which things that can be pushed do not hide.
  void scan_floor(const View& view, const Vec3& feet);

  /// The free way of a body of that half width along a unit direction, at most kSight: m.
  double free_way(const Vec2& from, const Vec2& direction, double body = kBody) const;
  /// Whether it would meet nothing on the straight way.
  bool is_free(const Vec2& from, const Vec2& to, double body = kBody) const;
  bool is_occupied(const Vec2& place) const;
  /// The unit direction to the nearest point that it sees; none if it sees none.
  std::optional<Vec2> to_nearest(const Vec2& from) const;
  /// Whether it sees a free way, straight or round obstacles, all the way.
  bool reaches(const Vec2& from, const Vec2& to) const;
  /// Hits of the last two scans, m.
  const std::vector<Vec2>& points() const { return points_; }

  /// The first place on a way round obstacles; none if no way is seen that leads nearer to `to`.
  /// Prefers to pass on the right.
  std::optional<Vec2> way_round(const Vec2& from, const Vec2& to) const;

  /// For two who approach each other: as far to the right as it is free, and ahead; none if
  /// nothing is.
  std::optional<Vec2> way_aside(const Vec2& from, const Vec2& to) const;

  /// Whether a person at `feet` can walk straight to `to` on the static shapes below, up and down
  /// slopes, past all others, and has room there.
  static bool is_walkable(const View& view, const Vec3& feet, const Vec2& to);

  /// Whether there is floor all the straight way of a person at `feet`, up and down slopes.
  static bool has_floor(const View& view, const Vec3& feet, const Vec2& to);
  /// Whether static shapes and the ends of the floor leave room for a person so near to a
  /// place that it arrives there.
  static bool has_room(const View& view, const Vec3& place);

  /// The model that can move and is nearest before a person at `feet` who looks along a unit
  /// direction; empty if it sees none.
  static std::string model_ahead(const View& view, const Vec3& feet, const Vec2& direction);

  /// The model that can move and is at a point, as seen by a person at `feet`; empty if none is.
  static std::string model_at(const View& view, const Vec3& feet, const Vec2& point);

  /// Removes the points that rays of a person at `feet` now pass.
  static void remove_gone(const View& view, const Vec3& feet, std::vector<Vec2>& points);

 private:
  void find_edges(const View& view, const Vec3& feet, std::vector<Vec2>& seen) const;

  std::vector<Vec2> points_;  // points of the last scan first
  std::size_t fresh_ = 0;     // number of points of the last scan
  bool turned_ = false;
  std::vector<rays::Ray> rays_;
  std::vector<rays::Hit> hits_;
};

}  // namespace angen::people
