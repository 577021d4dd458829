#include "light/reflected_light.h"

#include <algorithm>
#include <cmath>
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
constexpr float kLift = 0.02F;   // m off the surfaces that pieces are looked for
constexpr float kAlong = 0.99F;  // cosine to an axis that counts as along it
constexpr int kSlanted = 6;

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
float falloff(float squared_distance, float radius) {
  const float left = std::max(0.0F, 1.0F - squared_distance / (radius * radius));
  return left * left;
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
  void add(const Piece& piece, float weight) {
    if (!(weight > kMinWeight) || (full() && weight <= all_[kMax - 1].second)) return;
    int at = full() ? count_ - 1 : count_++;
    for (; at > 0 && all_[at - 1].second < weight; --at) all_[at] = all_[at - 1];
    all_[at] = {&piece, weight};
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
  bool full() const { return count_ == kMax; }

  std::array<std::pair<const Piece*, float>, kMax> all_{};
  int count_ = 0;
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
            [](const Cell& each, std::uint64_t wanted) { return each.key < wanted; });
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

/// Pieces near the point's cell that may face the same way.
const std::vector<Piece>& ReflectedLookup::alike(const Eigen::Vector3f& point,
                                                 const Eigen::Vector3f& normal) {
  const int nearest = axis_of(normal);
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();
  axis[nearest / 2] = nearest % 2 == 0 ? 1.0F : -1.0F;
  const bool along = axis.dot(normal) > kAlong;
  const Eigen::Vector3i cell = cell_of(point, kNearPoint);
  const auto entry = alike_[along ? nearest : kSlanted].try_emplace(key_of(cell));
  Pieces& found = entry.first->second;
  if (!entry.second) return found;
  light_.fine_.near(box_of(cell, kNearPoint, kNearPoint), [&](const Piece& piece) {
    if (!along || axis.dot(piece.normal) > 0.0F) found.push_back(piece);
  });
  return found;
}

const std::vector<Piece>& ReflectedLookup::around(const Eigen::Vector3f& point) {
  const Eigen::Vector3i cell = cell_of(point, kMerged);
  const auto entry = around_.try_emplace(key_of(cell));
  Pieces& found = entry.first->second;
  if (entry.second) {
    light_.coarse_.near(box_of(cell, kMerged, kFar),
                        [&](const Piece& piece) { found.push_back(piece); });
  }
  return found;
}

Eigen::Vector3f ReflectedLookup::at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f from = point + kLift * normal;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Heaviest same;
  for (const Piece& piece : alike(point, normal)) {
    const Eigen::Vector3f way = point - piece.position;
    const float direct = way.squaredNorm();
    if (direct >= kNearPoint * kNearPoint) continue;  // most of them
    const float facing = normal.dot(piece.normal);
    if (facing <= 0.0F) continue;
    const float off = way.dot(normal);
    const float squared = direct + (kOffPlane * kOffPlane - 1.0F) * off * off;
    same.add(piece, facing * facing * falloff(squared, kNearPoint));
  }
  if (same.mean(from, visible_, mean)) return mean;
  Heaviest any;
  for (const Piece& piece : around(point)) {
    const Eigen::Vector3f way = from - piece.position;
    if (way.dot(piece.normal) > 0.0F) any.add(piece, falloff(way.squaredNorm(), kFar));
  }
  any.mean(from, visible_, mean);
  return mean;
}

}  // namespace angen::light
