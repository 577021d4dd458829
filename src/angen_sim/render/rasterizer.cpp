#include "render/rasterizer.h"

#include <cmath>

#include "render/shade.h"

namespace angen::render {
namespace {

constexpr double kEdgeOn = 1e-9;  // m from the eye to the plane of a face that is seen as a line

using Edges = Eigen::Array4f;

}  // namespace

bool Rasterizer::start(int column, int row, int size, float depth) {
  column_ = column;
  row_ = row;
  first_ = eye_.toward(column, row);
  right_ = eye_.toward(column + 1, row) - first_;
  down_ = eye_.toward(column, row + 1) - first_;
  const auto far = static_cast<float>(eye_.camera().far);
  reaches_far_ = !(depth < far);
  least_closeness_ = 1.0F / std::min(depth, far);
  most_closeness_ = 1.0F / static_cast<float>(eye_.camera().near);
  in_view_.clear();
  lacking_.clear();
  const Hull hull = eye_.hull(column, row, size, depth);
  if (!look_for(hull, instances_.fixed_number())) return false;
  instances_.any_mover_in(hull, [&](std::uint32_t number) {
    const std::size_t before = in_view_.size();
    if (!look_for(instances_[number].in_patch(hull), number)) {
      in_view_.resize(before);
      lacking_.push_back(number);
    }
    return false;
  });
  shown_.clear();
  for (const InView& each : in_view_) show(each);
  List& all = lists_[0];
  for (all.count = 0; all.count < shown_.size(); ++all.count) {
    all.all[all.count] = static_cast<std::uint8_t>(all.count);
  }
  return true;
}

/// Lists the faces of an instance in the hull, which is in its frame. False if they are too many,
/// or include a heightmap.
bool Rasterizer::look_for(const Hull& hull, std::uint32_t instance) {
  const Placed& placed = instances_[instance];
  const auto add = [&](const Face& face, std::uint32_t triangle, bool has_texture) {
    if (in_view_.size() == kMost) return false;
    in_view_.push_back(
        {placed.instance ? placed.in_world(face) : face, instance, triangle, has_texture});
    return true;
  };
  return placed.patch->each_in(hull, [&](std::uint32_t triangle, const Face& face) {
    if (!placed.patch->has_texture(triangle)) return add(face, triangle, false);
    const auto& [a, b, c, d] = face.corners;
    return add({{a, b, c, a}, 3}, triangle, true) &&
           (face.count < 4 || add({{a, c, d, a}, 3}, triangle + 1, true));
  });
}

void Rasterizer::show(const InView& of) {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = of.face.corners[k].cast<double>() - eye_.origin().cast<double>();
  }
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double volume = normal.dot(corners[0]);
  if (!(std::abs(volume) > kEdgeOn * normal.norm())) return;
  Shown& shown = shown_.emplace_back();
  for (std::size_t k = 0; k < 4; ++k) {
    Vec3 inward = corners[k].cross(corners[(k + 1) % 4]);  // 0 at the fourth edge of a triangle
    if (volume < 0.0) inward = -inward;
    const auto i = static_cast<Eigen::Index>(k);
    shown.inside[i] = static_cast<float>(inward.dot(first_));
    shown.inside_right[i] = static_cast<float>(inward.dot(right_));
    shown.inside_down[i] = static_cast<float>(inward.dot(down_));
  }
  shown.closeness = static_cast<float>(normal.dot(first_) / volume);
  shown.closeness_right = static_cast<float>(normal.dot(right_) / volume);
  shown.closeness_down = static_cast<float>(normal.dot(down_) / volume);
  shown.instance = of.instance;
  shown.triangle = of.triangle;
  shown.has_texture = of.has_texture;
}

void Rasterizer::find_hits(int column, int row, std::array<TileRays, kTilesOfASquare>& tiles,
                           std::array<bool, kTilesOfASquare>& found) {
  divide({column - column_, row - row_, kSquare}, lists_[0], 1, tiles.data(), found.data());
}

void Rasterizer::divide(const Square& square, const List& above, std::size_t level, TileRays* tiles,
                        bool* found) {
  const int count = square.size * square.size / kLanes;
  List& own = lists_[level];
  if (choose(square, above, own)) {
    for (int k = 0; k < count; ++k) {
      const Square tile{square.x + kTile * every_other_bit(k),
                        square.y + kTile * every_other_bit(k >> 1), kTile};
      fill(tile, shown_[own.all[0]], tiles[k].rays);
      found[k] = true;
    }
  } else if (count == 1) {
    *found = compare(square, own, *tiles);
  } else {
    const int half = square.size / 2, part = count / 4;
    for (int k = 0; k < 4; ++k) {
      divide({square.x + half * (k & 1), square.y + half * (k >> 1), half}, own, level + 1,
             tiles + k * part, found + k * part);
    }
  }
}

/// Chooses the faces that may be the first ones in a square. True if one covers all of it. Bounds
/// are the values at corners, as rounding keeps their order.
bool Rasterizer::choose(const Square& square, const List& from, List& to) const {
  const auto left = static_cast<float>(square.x), top = static_cast<float>(square.y);
  const auto right = static_cast<float>(square.x + square.size - 1);
  const auto bottom = static_cast<float>(square.y + square.size - 1);
  std::array<float, kMost> closest;
  float covered = 0.0F;  // closeness behind which nothing is seen
  std::size_t covering = kMost;
  to.count = 0;
  for (std::size_t n = 0; n < from.count; ++n) {
    const Shown& face = shown_[from.all[n]];
    const Edges a = face.inside_right * left, b = face.inside_right * right;
    const Edges c = face.inside_down * top, d = face.inside_down * bottom;
    if ((((face.inside + a.max(b)) + c.max(d)) < 0.0F).any()) continue;
    const auto [least_right, most_right] =
        std::minmax({face.closeness_right * left, face.closeness_right * right});
    const auto [least_down, most_down] =
        std::minmax({face.closeness_down * top, face.closeness_down * bottom});
    const float least = (face.closeness + least_right) + least_down;
    const float most = (face.closeness + most_right) + most_down;
    if (!(most >= least_closeness_) || most < covered) continue;
    closest[to.count] = most;
    if (least > covered && least >= least_closeness_ && most <= most_closeness_ &&
        (((face.inside + a.min(b)) + c.min(d)) >= 0.0F).all()) {
      covered = least;
      covering = to.count;
    }
    to.all[to.count++] = from.all[n];
  }
  if (covering == kMost) return false;
  std::size_t kept = 0;
  for (std::size_t n = 0; n < to.count; ++n) {
    if (closest[n] >= covered) to.all[kept++] = to.all[n];
  }
  to.count = kept;
  return kept == 1;
}

void Rasterizer::fill(const Square& tile, const Shown& face, RTCRayHit16& rays) const {
  for (int i = 0; i < kLanes; ++i) {
    const auto x = static_cast<float>(tile.x + i % kTile);
    const auto y = static_cast<float>(tile.y + i / kTile);
    set_hit(face, x, y, i, (face.closeness + x * face.closeness_right) + y * face.closeness_down,
            rays);
  }
}

/// Finds the first face at each pixel. False if a ray of the image has none and goes farther.
bool Rasterizer::compare(const Square& tile, const List& faces, TileRays& to) const {
  Lanes x, y, closest = Lanes::Zero();
  Eigen::Array<int, kLanes, 1> first = Eigen::Array<int, kLanes, 1>::Constant(-1);
  for (int i = 0; i < kLanes; ++i) {
    x[i] = static_cast<float>(tile.x + i % kTile);
    y[i] = static_cast<float>(tile.y + i / kTile);
  }
  for (std::size_t n = 0; n < faces.count; ++n) {
    const Shown& face = shown_[faces.all[n]];
    const Lanes closeness = (face.closeness + x * face.closeness_right) + y * face.closeness_down;
    Lanes inside = (face.inside[0] + x * face.inside_right[0]) + y * face.inside_down[0];
    for (int k = 1; k < 4; ++k) {
      inside = inside.min((face.inside[k] + x * face.inside_right[k]) + y * face.inside_down[k]);
    }
    for (int i = 0; i < kLanes; ++i) {
      const bool is_first = inside[i] >= 0.0F && closeness[i] > closest[i] &&
                            closeness[i] >= least_closeness_ && closeness[i] <= most_closeness_;
      closest[i] = is_first ? closeness[i] : closest[i];
      first[i] = is_first ? static_cast<int>(faces.all[n]) : first[i];
    }
  }
  for (int i = 0; i < kLanes; ++i) {
    if (first[i] < 0 && to.valid[i] != 0 && !reaches_far_) return false;
  }
  for (int i = 0; i < kLanes; ++i) {
    if (first[i] < 0) continue;
    set_hit(shown_[static_cast<std::size_t>(first[i])], x[i], y[i], i, closest[i], to.rays);
  }
  return true;
}

void Rasterizer::set_hit(const Shown& face, float x, float y, int i, float closeness,
                         RTCRayHit16& rays) const {
  rays.ray.tfar[i] = 1.0F / closeness;
  rays.hit.geomID[i] = 0;
  rays.hit.primID[i] = face.triangle;
  rays.hit.instID[0][i] = face.instance;
  if (!face.has_texture) return;
  // The corners' weights are the values at the edges opposite to them.
  const Edges weights = (face.inside + x * face.inside_right) + y * face.inside_down;
  const float sum = weights[0] + weights[1] + weights[2];
  rays.hit.u[i] = weights[2] / sum;
  rays.hit.v[i] = weights[0] / sum;
}

}  // namespace angen::render
