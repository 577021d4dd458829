#include "render/hull.h"

#include <algorithm>
#include <limits>
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

}  // namespace

Hull::Hull(const Box& from, const Box& to) : from_(from), to_(to), box_(from.merged(to)) {
  for (const auto& [u, v] : {std::pair{0, 1}, {1, 2}, {2, 0}}) add_sides(u, v);
  const float more = margin();
  offset_ += more;
  box_.min().array() -= more;
  box_.max().array() += more;
}

float Hull::margin() const {
  return kRounding + kRoundingPerMeter * std::max(box_.min().cwiseAbs().maxCoeff(),
                                                  box_.max().cwiseAbs().maxCoeff());
}

// Seen along an axis, two lines through the middle of `from` and a corner of `to` have all other
// corners on one side of them; none if that middle is within `to`. They are moved out until `from`
// is on that side as well.
void Hull::add_sides(int u, int v) {
  const auto part = [&](const Eigen::Vector3f& p) {
    return Eigen::Vector2f(p[u] - from_.center()[u], p[v] - from_.center()[v]);
  };
  rays::each_silhouette<float>(part(to_.min()), part(to_.max()), [&](const Eigen::Vector2f& way) {
    Eigen::Vector3f outward = Eigen::Vector3f::Zero();
    outward[u] = way.x();
    outward[v] = way.y();
    for (int axis = 0; axis < 3; ++axis) outward_[axis][side_count_] = outward[axis];
    offset_[side_count_++] = std::max(support(from_, outward), support(to_, outward));
  });
}

Hull Hull::seen_from(const Eigen::Matrix3f& rotation, const Eigen::Vector3f& position) const {
  Hull made;
  made.offset_ = offset_;
  made.side_count_ = side_count_;
  for (int axis = 0; axis < 3; ++axis) {
    made.offset_ -= outward_[axis] * position[axis];
    for (int i = 0; i < 3; ++i) made.outward_[axis] += rotation(i, axis) * outward_[i];
  }
  for (const Box* box : {&from_, &to_}) {
    const Eigen::Vector3f center = rotation.transpose() * (box->center() - position);
    const Eigen::Vector3f half = rotation.transpose().cwiseAbs() * (0.5F * box->sizes());
    made.box_.extend(Box(center - half, center + half));
  }
  const float more = margin();
  made.box_.min().array() -= more;
  made.box_.max().array() += more;
  return made;
}

Four Hull::overlaps(const Boxes4& boxes) const {
  using Column = Boxes4::Column;
  Column beyond = Column::Constant(-std::numeric_limits<float>::infinity());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    beyond = beyond.max(boxes.min[axis] - box_.max()[i]).max(box_.min()[i] - boxes.max[axis]);
  }
  for (int side = 0; side < side_count_; ++side) {
    Column sum = Column::Constant(-offset_[side]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum +=
          outward_[axis][side] * (outward_[axis][side] > 0.0F ? boxes.min[axis] : boxes.max[axis]);
    }
    beyond = beyond.max(sum);
  }
  Four found = 0;
  for (int i = 0; i < 4; ++i) found |= beyond[i] > 0.0F ? 0U : 1U << static_cast<unsigned>(i);
  return found;
}

bool Hull::overlaps(const Face& face) const {
  Box box;
  Sides nearest = Sides::Constant(std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < face.count; ++i) {
    const Eigen::Vector3f& p = face.corners[i];
    box.extend(p);
    const Sides beyond = outward_[0] * p.x() + outward_[1] * p.y() + outward_[2] * p.z() - offset_;
    nearest = nearest.min(beyond);
  }
  return box.intersects(box_) && !(nearest.maxCoeff() > 0.0F);
}

/// False where the segment between the middles does not cross the face, by floats.
bool Hull::may_be_cut_by(const Face& face) const {
  const Eigen::Vector3f from = from_.center(), way = to_.center() - from;
  const Eigen::Vector3f& first = face.corners[0];
  const Eigen::Vector3f normal = (face.corners[1] - first).cross(face.corners[2] - first);
  const float before = normal.dot(from - first);
  const float side = before > 0.0F ? 1.0F : -1.0F;
  if (!(side * (before + normal.dot(way)) < 0.0F)) return false;
  for (std::size_t k = 0; k < face.count; ++k) {
    const Eigen::Vector3f& corner = face.corners[k];
    const Eigen::Vector3f edge = face.corners[k + 1 < face.count ? k + 1 : 0] - corner;
    if (!(side * edge.cross(from - corner).dot(way) < 0.0F)) return false;
  }
  return true;
}

// A segment from a to b passes an edge on the inner side by the sign of the volume that both
// span, which is linear in a and in b: it is that of the middles, give or take what the boxes'
// halves add.
bool Hull::is_cut_by(const Face& face) const {
  if (!may_be_cut_by(face)) return false;
  const auto at = [&](std::size_t i) -> Eigen::Vector3d {
    return face.corners[i % face.count].cast<double>();
  };
  const double least = margin();
  const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  const Eigen::Vector3d half_from = from_.sizes().cast<double>() / 2.0;
  const Eigen::Vector3d half_to = to_.sizes().cast<double>() / 2.0;
  const Eigen::Vector3d from = from_.center().cast<double>(), to = to_.center().cast<double>();
  const double side = normal.dot(from - at(0)) > 0.0 ? 1.0 : -1.0;
  const Eigen::Vector3d lean = normal.cwiseAbs();
  if (!(side * normal.dot(from - at(0)) - lean.dot(half_from) > least &&
        -side * normal.dot(to - at(0)) - lean.dot(half_to) > least)) {
    return false;
  }
  const double length = box_.sizes().cast<double>().norm();
  for (std::size_t k = 0; k < face.count; ++k) {
    const Eigen::Vector3d edge = at(k + 1) - at(k), reach = edge.cwiseAbs();
    const Eigen::Vector3d across = edge.cross(from - at(k));
    const Eigen::Vector3d spread(reach.y() * half_from.z() + reach.z() * half_from.y(),
                                 reach.z() * half_from.x() + reach.x() * half_from.z(),
                                 reach.x() * half_from.y() + reach.y() * half_from.x());
    const Eigen::Vector3d way = to - at(k);
    const double most = -side * across.dot(way) - across.cwiseAbs().dot(half_to) -
                        spread.dot(way.cwiseAbs() + half_to);
    if (!(most > least * edge.norm() * length)) return false;
  }
  return true;
}

}  // namespace angen::render
