#include "light/reflected_light.h"

#include <algorithm>
#include <mutex>
#include <tuple>
#include <utility>

#include "core/cells.h"

namespace angen::light {
namespace {

using Piece = ReflectedLight::Piece;

constexpr float kNearPoint = 0.6F, kFar = 2.4F;  // m
constexpr float kMerged = 1.2F;  // m, side of cells whose pieces are merged for larger distances
// Factor of distances off the plane of a surface: a piece there is part of another surface.
constexpr float kOffPlane = 3.0F;
constexpr float kMinWeight = 1e-3F;
constexpr float kLift = 0.02F;            // m off the surfaces that pieces are looked for
constexpr float kAlong = 0.99F;           // cosine to an axis that counts as along it
constexpr int kSlanted = 6, kAround = 7;  // further than the six axes
constexpr std::size_t kMaxCells = 1024;   // cells of some 5 kB; a camera that moves leaves old ones

Eigen::Vector3i cell_of(const Eigen::Vector3f& point, float step) {
  return (point / step).array().floor().cast<int>();
}

std::uint64_t key_of(const Eigen::Vector3i& cell) { return cell_key(cell.x(), cell.y(), cell.z()); }

Eigen::AlignedBox3f box_of(const Eigen::Vector3i& cell, float step, float margin) {
  const Eigen::Vector3f low = step * cell.cast<float>();
  return {low.array() - margin, low.array() + step + margin};
}

/// 0 to 5: the signed axis nearest to a normal.
int axis_of(const Eigen::Vector3f& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (normal[axis] < 0.0F ? 1 : 0);
}

/// 1 at the middle, 0 from `radius` on, smooth between.
template <class Squares>
auto falloff(const Squares& squared_distances, float radius) {
  return (1.0F - squared_distances / (radius * radius)).max(0.0F).square();
}

/// An order that does not depend on which piece was found first.
bool is_before(const Piece& a, const Piece& b) {
  const auto key = [](const Piece& of) {
    return std::make_tuple(of.position.x(), of.position.y(), of.position.z(), of.normal.x(),
                           of.normal.y(), of.normal.z());
  };
  return key(a) < key(b);
}

/// The pieces of the largest weights, in descending order.
class Heaviest {
 public:
  void add(const std::vector<Piece>& pieces, const Eigen::ArrayXf& weights) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const float weight = weights[static_cast<Eigen::Index>(i)];
      if (weight > least_) add(pieces[i], weight);  // few of them
    }
  }

  /// The mean light of the visible ones; false if there are none.
  bool mean(const Eigen::Vector3f& from, const ReflectedLookup::Visible& visible,
            Eigen::Vector3f& out) const {
    if (count_ == 0) return false;
    std::array<Eigen::Vector3f, kMax> places;
    for (int i = 0; i < count_; ++i) {
      places[i] = all_[i].first->position + kLift * all_[i].first->normal;
    }
    const std::uint32_t seen = visible(from, places.data(), count_);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float weights = 0.0F;
    for (int i = 0; i < count_; ++i) {
      if ((seen >> i & 1U) == 0) continue;
      sum += all_[i].second * all_[i].first->light;
      weights += all_[i].second;
    }
    if (weights > 0.0F) out = sum / weights;
    return weights > 0.0F;
  }

 private:
  static constexpr int kMax = ReflectedLookup::kMax;

  void add(const Piece& piece, float weight) {
    int at = count_ == kMax ? count_ - 1 : count_++;
    for (; at > 0 && all_[at - 1].second < weight; --at) all_[at] = all_[at - 1];
    all_[at] = {&piece, weight};
    if (count_ == kMax) least_ = all_[kMax - 1].second;
  }

  std::array<std::pair<const Piece*, float>, kMax> all_{};
  int count_ = 0;
  float least_ = kMinWeight;  // others do not count
};

}  // namespace

ReflectedLight::Lattice::Lattice(const std::vector<Piece>& from, float of_step) : step(of_step) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    order.emplace_back(key_of(cell_of(from[i].position, step)), static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : is_before(from[a.second], from[b.second]);
  });
  pieces.reserve(from.size());
  for (const auto& [key, i] : order) {
    if (cells.empty() || cells.back().key != key) {
      cells.push_back({key, static_cast<std::uint32_t>(pieces.size()), 0});
    }
    ++cells.back().count;
    pieces.push_back(from[i]);
  }
}

std::vector<Piece> ReflectedLight::Lattice::merged() const {
  std::vector<Piece> all;
  const Eigen::Vector3f zero = Eigen::Vector3f::Zero();
  for (const Cell& cell : cells) {
    std::array<Piece, 6> sums;
    sums.fill({zero, zero, zero});
    std::array<float, 6> counts{};
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
      const int axis = axis_of(pieces[i].normal);
      sums[axis].position += pieces[i].position;
      sums[axis].normal += pieces[i].normal;
      sums[axis].light += pieces[i].light;
      counts[axis] += 1.0F;
    }
    for (int axis = 0; axis < 6; ++axis) {
      if (counts[axis] == 0.0F) continue;
      const Piece& sum = sums[axis];
      all.push_back(
          {sum.position / counts[axis], sum.normal.normalized(), sum.light / counts[axis]});
    }
  }
  return all;
}

/// Calls visit(piece) for all pieces in the box.
template <class Visit>
void ReflectedLight::Lattice::near(const Eigen::AlignedBox3f& box, Visit&& visit) const {
  const Eigen::Vector3i low = cell_of(box.min(), step), high = cell_of(box.max(), step);
  for (int x = low.x(); x <= high.x(); ++x) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int z = low.z(); z <= high.z(); ++z) {
        const std::uint64_t key = cell_key(x, y, z);
        const auto cell = std::lower_bound(
            cells.begin(), cells.end(), key,
            [](const Cell& each, std::uint64_t other) { return each.key < other; });
        if (cell == cells.end() || cell->key != key) continue;
        for (std::uint32_t i = cell->first; i < cell->first + cell->count; ++i) {
          if (box.contains(pieces[i].position)) visit(pieces[i]);
        }
      }
    }
  }
}

ReflectedLight::ReflectedLight(const std::vector<Piece>& pieces)
    : fine_(pieces, kNearPoint), coarse_(Lattice(pieces, kMerged).merged(), kFar) {}

ReflectedLight::Pieces::Pieces(std::vector<Piece> from)
    : all(std::move(from)), positions(all.size(), 3), normals(all.size(), 3) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    positions.row(static_cast<Eigen::Index>(i)) = all[i].position.transpose().array();
    normals.row(static_cast<Eigen::Index>(i)) = all[i].normal.transpose().array();
  }
}

/// For pieces that face the same way.
void ReflectedLight::Pieces::weigh_alike(const Eigen::Vector3f& point,
                                         const Eigen::Vector3f& normal,
                                         Eigen::ArrayXf& weights) const {
  const auto x = point.x() - positions.col(0), y = point.y() - positions.col(1),
             z = point.z() - positions.col(2);
  const auto facing =
      normal.x() * normals.col(0) + (normal.y() * normals.col(1) + normal.z() * normals.col(2));
  const auto off = x * normal.x() + (y * normal.y() + z * normal.z());
  const auto direct = x.square() + (y.square() + z.square());
  weights = off;
  weights = direct + (kOffPlane * kOffPlane - 1.0F) * weights * weights;
  weights = facing.max(0.0F).square() * falloff(weights, kNearPoint);
}

/// For pieces that face the point.
void ReflectedLight::Pieces::weigh_facing(const Eigen::Vector3f& from,
                                          Eigen::ArrayXf& weights) const {
  const auto x = from.x() - positions.col(0), y = from.y() - positions.col(1),
             z = from.z() - positions.col(2);
  const auto facing = x * normals.col(0) + (y * normals.col(1) + z * normals.col(2));
  weights = x.square() + (y.square() + z.square());
  weights = (facing > 0.0F).select(falloff(weights, kFar), 0.0F);
}

template <class Find>
std::shared_ptr<const ReflectedLight::Pieces> ReflectedLight::NearCells::at(std::uint64_t cell,
                                                                            const Find& find) {
  {
    const std::shared_lock<std::shared_mutex> lock(mutex_);
    const auto entry = known_.find(cell);
    if (entry != known_.end()) return entry->second;
  }
  auto found = std::make_shared<const Pieces>(find());  // another thread may find the same
  const std::unique_lock<std::shared_mutex> lock(mutex_);
  if (known_.size() >= kMaxCells) known_.clear();
  return known_.emplace(cell, std::move(found)).first->second;
}

/// The same as the last ones where the cell is.
template <class Find>
const ReflectedLookup::Pieces& ReflectedLookup::near(std::size_t which, std::uint64_t cell,
                                                     const Find& find) {
  Near& last = last_[which];
  if (!last.pieces || last.cell != cell) last = {cell, light_.near_[which].at(cell, find)};
  return *last.pieces;
}

/// Pieces near the point's cell that may face the same way.
const ReflectedLookup::Pieces& ReflectedLookup::alike(const Eigen::Vector3f& point,
                                                      const Eigen::Vector3f& normal) {
  const int nearest = axis_of(normal);
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();
  axis[nearest / 2] = nearest % 2 == 0 ? 1.0F : -1.0F;
  const bool along = axis.dot(normal) > kAlong;
  const Eigen::Vector3i cell = cell_of(point, kNearPoint);
  return near(static_cast<std::size_t>(along ? nearest : kSlanted), key_of(cell), [&] {
    std::vector<Piece> found;
    light_.fine_.near(box_of(cell, kNearPoint, kNearPoint), [&](const Piece& piece) {
      if (!along || axis.dot(piece.normal) > 0.0F) found.push_back(piece);
    });
    return found;
  });
}

const ReflectedLookup::Pieces& ReflectedLookup::around(const Eigen::Vector3f& point) {
  const Eigen::Vector3i cell = cell_of(point, kMerged);
  return near(kAround, key_of(cell), [&] {
    std::vector<Piece> found;
    light_.coarse_.near(box_of(cell, kMerged, kFar),
                        [&](const Piece& piece) { found.push_back(piece); });
    return found;
  });
}

Eigen::Vector3f ReflectedLookup::at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f from = point + kLift * normal;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Heaviest same;
  const Pieces& near = alike(point, normal);
  near.weigh_alike(point, normal, weights_);
  same.add(near.all, weights_);
  if (same.mean(from, visible_, mean)) return mean;
  Heaviest any;
  const Pieces& facing = around(point);
  facing.weigh_facing(from, weights_);
  any.add(facing.all, weights_);
  any.mean(from, visible_, mean);
  return mean;
}

}  // namespace angen::light
