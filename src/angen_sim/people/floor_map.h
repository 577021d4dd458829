#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "plugin/plugin.h"

namespace angen::people {

constexpr double kLow = 0.2;   // m: lower things are walked over
constexpr double kHead = 1.6;  // m: higher ones are passed below

/// The cells of 5 cm where a person fits between the static shapes of a storey. Everything that can
/// move, such as doors and chairs, is left out of it unless it is added.
class FloorMap {
 public:
  using Vec2 = Eigen::Vector2d;

  static constexpr double kCell = 0.05;       // m
  static constexpr double kClearance = 0.25;  // m, half a person's width
  static constexpr double kRoomyMap = 0.5;    // m: nearer to something costs more

  enum class Extent { kStorey, kStraight };

  /// Around both places, for a person whose feet are at `feet` (world, m): all of the storey, or
  /// only the part that is_clear() between them needs.
  FloorMap(const View& view, const Vec3& feet, const Vec2& to, Extent extent = Extent::kStorey);

  /// Whether a map of the storey around other places would be the same, without additions.
  bool serves(const View& view, const Vec3& feet, const Vec2& to) const;
  std::size_t cells() const { return squares_.size(); }

  /// Obstacles that were seen, m.
  void add_points(const std::vector<Vec2>& points);
  /// A way across this segment counts as that much longer (m).
  void add_toll(const Vec2& from, const Vec2& to, double toll);

  /// Whether a person fits there.
  bool is_free(const Vec2& place) const;
  /// Whether a person who walks straight stays free.
  bool is_clear(const Vec2& from, const Vec2& to) const;
  /// Whether there is floor along a straight way, but for gaps that one steps over.
  bool has_floor(const View& view, const Vec2& from, const Vec2& to) const;
  /// The best way on floor, as places at most two cells apart, to within `tolerance` (m) of `to`;
  /// none if no way leads there. Ways along the middle of a passage are better than ways along a
  /// wall.
  std::optional<std::vector<Vec2>> way(const View& view, const Vec2& from, const Vec2& to,
                                       double tolerance);

 private:
  struct Search;

  static Eigen::AlignedBox2d area(const View& view, const Eigen::AlignedBox2d& ends);
  void scan(const std::vector<double>& heights, const View& view);
  void scan_lines(const std::vector<double>& heights, const View& view, int axis);
  std::vector<double> other_heights(const View& view) const;  // m above the floor
  void add_span(const Vec2& enter, const Vec2& leave);
  void add_point(const Vec2& point);
  int column(double x) const;
  int row(double y) const;
  std::optional<int> cell_at(const Vec2& place) const;
  Vec2 place(int cell) const;
  /// The free cell next to a place, at most `reach` (m) away.
  std::optional<int> free_cell(const Vec2& near, double reach) const;
  double rate(int cell) const;
  /// m to the next obstacle, at most kRoomyMap.
  float gap(int cell) const;
  bool can_stand(const View& view, int cell);
  /// From a step above a place of the floor to a step below it.
  rays::Ray down_at(const Vec2& place) const;

  std::uint64_t revision_ = 0;  // revision of the static shapes
  Eigen::AlignedBox2d area_;    // m, of the storey
  Vec2 corner_ = Vec2::Zero();  // m, of the first cell
  double floor_ = 0.0;          // m
  int columns_ = 0;
  int rows_ = 0;
  int reach_ = static_cast<int>(kRoomyMap / kCell) + 1;  // cells, of distances to an obstacle
  std::vector<double> squares_;                          // m^2, of each cell's gap
  std::vector<float> toll_;                              // m, added to a way through the cell
  std::vector<char> known_;                              // whether its floor was looked at
  // Whether the cell has a static floor, as found so far; shared by the map's copies.
  std::shared_ptr<std::vector<char>> floored_;
};

}  // namespace angen::people
