#include "render/reflections.h"

#include <algorithm>
#include <cmath>

namespace angen::render {
namespace {

constexpr float kSamePlace = 0.1F;    // m; reflected light is that of patches of 0.4 m
constexpr float kSameCorner = 0.03F;  // m
constexpr float kSameWay = 0.98F;     // cosine between normals
constexpr float kSameHeight = 0.01F;  // m along the normal: what is in a gap has other light
constexpr float kSpan = 0.25F;        // m, diagonal of a piece
constexpr float kOffPlane = 1e-3F;    // m
constexpr float kOnePlane = 0.9999F;  // cosine between normals

/// Points that are visible from another, as bits; see light::ReflectedLookup.
std::uint32_t seen_from(const Eigen::Vector3f& from, const Eigen::Vector3f* to, int count,
                        const Instances& instances) {
  alignas(64) int wanted[kLanes] = {};
  alignas(64) RTCRay16 rays;
  Columns all, way;
  all.set_all(from);
  Box box(from);
  for (int i = 0; i < count; ++i) {
    wanted[i] = -1;
    way.set(i, to[i] - from);
    box.extend(to[i]);
  }
  set_segments(all, way, rays);
  box.min().array() -= kLift;
  box.max().array() += kLift;
  instances.find_occluded(wanted, {true, instances.has_opaque_mover_in(box)}, rays);
  std::uint32_t seen = 0;
  for (int i = 0; i < count; ++i) {
    if (rays.tfar[i] >= 0.0F) seen |= 1U << i;
  }
  return seen;
}

/// Whether light at one point is about that at another.
bool is_alike(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
              const Eigen::Vector3f& other, const Eigen::Vector3f& other_normal, float within) {
  const Eigen::Vector3f way = point - other;
  return normal.dot(other_normal) > kSameWay && way.squaredNorm() < within * within &&
         std::abs(normal.dot(way)) < kSameHeight;
}

/// Whether all pixels show one plane.
bool is_flat(const Tile& tile) {
  if (tile.is_even) return true;
  const Eigen::Vector3f point = tile.point[0], normal = tile.normal[0];
  const Columns& to = tile.point;
  const Lanes off = (to.x - point.x()) * normal.x() +
                    ((to.y - point.y()) * normal.y() + (to.z - point.z()) * normal.z());
  const Lanes facing =
      tile.normal.x * normal.x() + (tile.normal.y * normal.y() + tile.normal.z * normal.z());
  bool flat = true;
  for (int i = 0; i < kLanes; ++i) {
    flat = flat && tile.valid[i] != 0 && std::abs(off[i]) < kOffPlane && facing[i] > kOnePlane;
  }
  return flat;
}

}  // namespace

static_assert(light::ReflectedLookup::kMax == kLanes);

Reflections::Reflections(const light::ReflectedLight& light, const Instances& instances, int width)
    : lookup_(light, [&instances](const auto& from, const auto* to,
                                  int count) { return seen_from(from, to, count, instances); }),
      corners_across_(static_cast<std::size_t>(width + kBlock) / kTile + 1),
      corners_(corners_across_ * (kTilesAcross + 1)) {}

void Reflections::start() {
  for (Corner& corner : corners_) corner.count = 0;
}

const Reflections::Known* Reflections::Corner::find(const Eigen::Vector3f& point,
                                                    const Eigen::Vector3f& normal,
                                                    float within) const {
  const auto end = known.begin() + std::min(count, known.size());
  const auto found = std::find_if(known.begin(), end, [&](const Known& one) {
    return is_alike(point, normal, one.point, one.normal, within);
  });
  return found == end ? nullptr : &*found;
}

void Reflections::Corner::add(const Known& one) { known[count++ % known.size()] = one; }

Reflections::Corner& Reflections::corner(const Tile& tile, int right, int down) {
  const auto column = static_cast<std::size_t>(tile.column / kTile + right);
  const auto row = static_cast<std::size_t>(tile.row / kTile % kTilesAcross + down);
  return corners_[row * corners_across_ + column];
}

/// Light at a pixel beside that corner.
Eigen::Vector3f Reflections::at(Corner& corner, const Tile& tile, int pixel) {
  const Eigen::Vector3f point = tile.point[pixel], normal = tile.normal[pixel];
  const Known* known = corner.find(point, normal, kSameCorner);
  if (known != nullptr) return known->light;
  const Eigen::Vector3f light = lookup_.at(point, normal);
  corner.add({point, normal, light});
  return light;
}

void Reflections::find_flat(const std::array<Tile, kTiles>& tiles) {
  for (std::size_t k = 0; k < kTiles; ++k) {
    Piece& piece = pieces_[kFirstTile + k];
    piece.is_flat = has_[k] && is_flat(tiles[k]);
    if (piece.is_flat) piece = {tiles[k].point[0], tiles[k].normal[0], tiles[k].seen, true};
  }
  for (std::size_t square = kFirstTile; square-- > 0;) {
    const Piece* parts = &pieces_[4 * square + 1];
    Piece whole = parts[0];
    for (int k = 1; k < 4; ++k) {
      const Piece& part = parts[k];
      whole.is_flat = whole.is_flat && part.is_flat && whole.normal.dot(part.normal) > kOnePlane &&
                      std::abs(whole.normal.dot(part.point - whole.point)) < kOffPlane;
      if (whole.is_flat) whole.box.extend(part.box);
    }
    whole.is_flat = whole.is_flat && whole.box.diagonal().squaredNorm() < kSpan * kSpan;
    pieces_[square] = whole;
  }
}

void Reflections::shine(std::array<Tile, kTiles>& tiles, const std::array<bool, kTiles>& has) {
  has_ = has;
  find_flat(tiles);
  shine(tiles, 0, kTilesAcross);
}

void Reflections::shine(std::array<Tile, kTiles>& tiles, std::size_t square, int across) {
  if (across == 1) {
    if (has_[square - kFirstTile]) shine_each(tiles[square - kFirstTile]);
    return;
  }
  if (!pieces_[square].is_flat) {
    for (std::size_t k = 1; k <= 4; ++k) shine(tiles, 4 * square + k, across / 2);
    return;
  }
  std::size_t first = square;
  while (first < kFirstTile) first = 4 * first + 1;
  shine_flat(&tiles[first - kFirstTile], across);
}

/// Interpolates between the corners of a square of tiles.
void Reflections::shine_flat(Tile* tiles, int across) {
  const int count = across * across, last = count - 1;
  const int upper_right = last / 3, lower_left = 2 * upper_right;  // in Z-order
  const Eigen::Vector3f a = at(corner(tiles[0], 0, 0), tiles[0], 0);
  const Eigen::Vector3f b = at(corner(tiles[upper_right], 1, 0), tiles[upper_right], kTile - 1);
  const Eigen::Vector3f c = at(corner(tiles[lower_left], 0, 1), tiles[lower_left], kLanes - kTile);
  const Eigen::Vector3f d = at(corner(tiles[last], 1, 1), tiles[last], kLanes - 1);
  const Eigen::Vector3f right = b - a, down = c - a, both = (d - b) - down;
  const float step = 1.0F / static_cast<float>(kTile * across - 1);
  for (int k = 0; k < count; ++k) {
    Tile& tile = tiles[k];
    Lanes u, v;
    for (int i = 0; i < kLanes; ++i) {
      u[i] = step * static_cast<float>(tile.column - tiles[0].column + i % kTile);
      v[i] = step * static_cast<float>(tile.row - tiles[0].row + i / kTile);
    }
    const Lanes uv = u * v;
    tile.light.x += a.x() + u * right.x() + v * down.x() + uv * both.x();
    tile.light.y += a.y() + u * right.y() + v * down.y() + uv * both.y();
    tile.light.z += a.z() + u * right.z() + v * down.z() + uv * both.z();
  }
}

/// Near pixels get the same.
void Reflections::shine_each(Tile& tile) {
  const std::array<Corner*, 4> corners{&corner(tile, 0, 0), &corner(tile, 1, 0),
                                       &corner(tile, 0, 1), &corner(tile, 1, 1)};
  std::array<Known, kLanes> now;
  std::size_t count = 0;
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] == 0) continue;
    const Eigen::Vector3f point = tile.point[i], normal = tile.normal[i];
    const Known* found = nullptr;
    for (std::size_t k = 0; found == nullptr && k < count; ++k) {
      if (is_alike(point, normal, now[k].point, now[k].normal, kSamePlace)) found = &now[k];
    }
    if (found == nullptr) {
      for (std::size_t k = 0; found == nullptr && k < 4; ++k) {
        found = corners[k]->find(point, normal, kSamePlace);
      }
      now[count] = found != nullptr ? *found : Known{point, normal, lookup_.at(point, normal)};
      found = &now[count++];
    }
    tile.light.set(i, tile.light[i] + found->light);
  }
  for (Corner* each : corners) {
    for (std::size_t k = 0; k < count; ++k) {
      if (each->find(now[k].point, now[k].normal, 1e-4F) == nullptr) each->add(now[k]);
    }
  }
}

}  // namespace angen::render
