#pragma once

#include <functional>
#include <memory>

#include "render/instances.h"
#include "render/pinhole_camera.h"

namespace angen::render {

/// Sixteen pixels at once: a tile of 4 x 4.
constexpr int kTile = 4;
constexpr int kLanes = kTile * kTile;
/// A block is divided into four squares, each of these into four, and so on down to tiles. Tiles
/// are counted square by square (Z-order).
constexpr int kDivisions = 3;
constexpr int kTilesAcross = 1 << kDivisions;
constexpr int kTiles = kTilesAcross * kTilesAcross;
constexpr int kBlock = kTilesAcross * kTile;  // pixels

/// A block's squares on all levels: 1 + 4 + 16 + 64, the last ones are the tiles. Those of square i
/// are 4 i + 1 to 4 i + 4.
constexpr int kFirstTile = 1 + 4 + 16;
constexpr int kSquares = kFirstTile + kTiles;
static_assert(kDivisions == 3);

constexpr int kTilesOfASquare = 16;  // whose faces and movers are looked for at once
constexpr int kSquare = 4 * kTile;   // pixels

/// Bits 0, 2, 4, … as bits 0, 1, 2, …: the column of a tile in Z-order.
constexpr int every_other_bit(int of) {
  int bits = 0;
  for (int i = 0; i < kDivisions; ++i) bits |= (of >> (2 * i) & 1) << i;
  return bits;
}

/// The rays of a tile, with their hits. The length of a direction makes a range the depth.
struct TracedTile {
  int number = 0;              // in its block
  int column = 0, row = 0;     // place of its first pixel
  const int* valid = nullptr;  // not 0 in the image
  const RTCRayHit16& rays;

  bool has_hit(int i) const {
    return valid[i] != 0 && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
  }
  Eigen::Vector3f direction(int i) const {
    return {rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i]};
  }
};

/// Receives the tiles of an image: those of a row of blocks from left to right, block after block.
class Visitor {
 public:
  virtual ~Visitor() = default;
  virtual void begin_row_of_blocks() {}
  virtual void add(const TracedTile& tile) = 0;
  virtual void end_block() {}
};

/// Finds the hits of all tiles on up to `threads` threads. Each makes its own visitor, which gets
/// rows of blocks in any order.
void trace(const PinholeCamera& camera, const Pose& pose, const Instances& instances, int threads,
           const std::function<std::unique_ptr<Visitor>()>& make);

}  // namespace angen::render
