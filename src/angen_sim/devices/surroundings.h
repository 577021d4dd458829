#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "plugin/view.h"

namespace angen::devices {

/// What is around a person: where surfaces stand between shin and chest, up to kSight away. What
/// is hidden counts as free.
class Surroundings {
 public:
  using Vec2 = Eigen::Vector2d;

  static constexpr double kSight = 3.0;  // m
  static constexpr double kBody = 0.26;  // m, half a person's width and a centimeter

  /// Casts rays from a body that stands at `feet` (world, m). Keeps what those of the scan before
  /// met.
  void scan(const View& view, const Vec3& feet);

  /// How far a body of that half width gets along a unit direction, at most kSight: m.
  double free_way(const Vec2& from, const Vec2& direction, double body = kBody) const;
  /// Whether it would meet nothing on the straight way.
  bool is_free(const Vec2& from, const Vec2& to, double body = kBody) const;
  bool is_occupied(const Vec2& place) const;

  /// The first place to make for on a way round what stands between; none where no way is seen that
  /// leads nearer to `to`. Rather passes on the right.
  std::optional<Vec2> way_round(const Vec2& from, const Vec2& to) const;

 private:
  std::optional<Vec2> way_round(const Vec2& from, const Vec2& to, double body) const;

  std::vector<Vec2> points_;  // those of the last scan first
  std::size_t fresh_ = 0;     // how many those are
  bool turned_ = false;
  std::vector<rays::Ray> rays_;
  std::vector<rays::Hit> hits_;
};

}  // namespace angen::devices
