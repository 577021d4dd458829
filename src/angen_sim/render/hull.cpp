#include "render/hull.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rays/silhouette.h"

namespace angen::render {
namespace {

constexpr float kRounding = 1e-4F;          // m
constexpr float kRoundingPerMeter = 1e-6F;  // from the origin

/// Most of outward . p in a box.
float support(const Box& box, const Eigen::Vector3f& outward) {
  return (outward.array() > 0.0F).select(box.max(), box.min()).dot(outward);
}

Eigen::Vector3f corner(const Box& box, int i) {
  return box.corner(static_cast<Box::CornerType>(i));
}

}  // namespace

Hull::Hull(const Box& from, const Box& to) : from_(from), to_(to), box_(from.merged(to)) {
  for (const auto& [u, v] : {std::pair{0, 1}, {1, 2}, {2, 0}}) add_sides(u, v);
  const float more = margin();
  for (std::size_t i = 0; i < side_count_; ++i) sides_[i].offset += more;
  box_.min().array() -= more;
  box_.max().array() += more;
}

float Hull::margin() const {
  return kRounding + kRoundingPerMeter * std::max(box_.min().cwiseAbs().maxCoeff(),
                                                  box_.max().cwiseAbs().maxCoeff());
}

// As seen along an axis, two lines through the middle of `from` and a corner of `to` have all other
// corners on one side of them; none if that middle is within `to`. They are moved out until `from`
// is on that side as well.
void Hull::add_sides(int u, int v) {
  const auto part = [&](const Eigen::Vector3f& p) {
    return Eigen::Vector2f(p[u] - from_.center()[u], p[v] - from_.center()[v]);
  };
  rays::each_silhouette<float>(
      part(to_.min()), part(to_.max()), [&](const Eigen::Vector2f& outward) {
        Side& side = sides_[side_count_++];
        side.outward.setZero();
        side.outward[u] = outward.x();
        side.outward[v] = outward.y();
        side.offset = std::max(support(from_, side.outward), support(to_, side.outward));
      });
}

Hull Hull::seen_from(const Eigen::Matrix3f& rotation, const Eigen::Vector3f& position) const {
  Hull made;
  made.side_count_ = side_count_;
  for (std::size_t i = 0; i < side_count_; ++i) {
    const Side& side = sides_[i];
    made.sides_[i] = {rotation.transpose() * side.outward,
                      side.offset - side.outward.dot(position)};
  }
  for (int i = 0; i < 8; ++i) {
    made.box_.extend(rotation.transpose() * (corner(from_, i) - position));
    made.box_.extend(rotation.transpose() * (corner(to_, i) - position));
  }
  const float more = margin();
  made.box_.min().array() -= more;
  made.box_.max().array() += more;
  return made;
}

bool Hull::overlaps(const Box& box) const {
  if (!box.intersects(box_)) return false;
  return std::all_of(sides_.begin(), sides_.begin() + side_count_,
                     [&](const Side& side) { return -support(box, -side.outward) <= side.offset; });
}

// A segment from a to b passes an edge on the inner side by the sign of the volume that both span,
// which is linear in a and in b: its extremes are at corners of the boxes.
bool Hull::is_cut_by(const Face& face) const {
  const auto at = [&](std::size_t i) -> Eigen::Vector3d {
    return face.corners[i % face.count].cast<double>();
  };
  const double least = margin();
  const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  const auto least_above = [&](const Box& box, double side) {
    const Eigen::Vector3d half = box.sizes().cast<double>() / 2.0;
    const Eigen::Vector3d middle = box.center().cast<double>() - at(0);
    return side * normal.dot(middle) - normal.cwiseAbs().dot(half);
  };
  const double side = normal.dot(from_.center().cast<double>() - at(0)) > 0.0 ? 1.0 : -1.0;
  if (!(least_above(from_, side) > least && least_above(to_, -side) > least)) return false;
  const double length = box_.sizes().cast<double>().norm();
  const Eigen::Vector3d half = to_.sizes().cast<double>() / 2.0;
  for (std::size_t k = 0; k < face.count; ++k) {
    const Eigen::Vector3d edge = at(k + 1) - at(k);
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d across = edge.cross(corner(from_, i).cast<double>() - at(k));
      const double most =
          -side * across.dot(to_.center().cast<double>() - at(k)) - across.cwiseAbs().dot(half);
      if (!(most > least * edge.norm() * length)) return false;
    }
  }
  return true;
}

}  // namespace angen::render
