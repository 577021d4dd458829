#include "render/tracer.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "render/rasterizer.h"

namespace angen::render {
namespace {

constexpr float kHousing = 0.5F;    // m, in depth: largest distance of a housing's walls
constexpr float kPastWall = 1e-5F;  // m
constexpr int kMaxWalls = 8;
constexpr auto kCoherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
constexpr float kInexact = 1e5F;           // m; hulls are inexact beyond
constexpr float kDeeper = 1.01F;           // than the deepest of some rays of a square
constexpr int kPixelsOfAThread = 1 << 13;  // fewer are not worth its start

bool hits(const RTCRayHit16& rays, int i) { return rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; }

/// Continues rays that have hit a near surface from behind: many cameras are inside their own
/// housing, which renderers that cull back faces do not show.
void leave_housing(const Instances& instances, float far, const int* valid, RTCRayHit16& rays) {
  alignas(64) int inside[kLanes];
  for (int walls = 0; walls < kMaxWalls; ++walls) {
    bool any = false;
    for (int i = 0; i < kLanes; ++i) {
      inside[i] = 0;
      if (valid[i] == 0 || !hits(rays, i) || rays.ray.tfar[i] > kHousing) continue;
      const Placed& placed = instances[rays.hit.instID[0][i]];
      const Eigen::Vector3f normal =
          placed.rotation * placed.patch->facet(rays.hit.geomID[i], rays.hit.primID[i]).normal;
      if (normal.dot(Eigen::Vector3f(rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i])) <=
          0.0F)
        continue;
      inside[i] = -1;
      any = true;
      rays.ray.tnear[i] = rays.ray.tfar[i] + kPastWall;
      rays.ray.tfar[i] = far;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!any) return;
    instances.find_hits(inside, {}, RTC_INTERSECT_CONTEXT_FLAG_NONE, rays);
  }
}

/// The work of one thread.
class Tracer {
 public:
  Tracer(const Eye& eye, const Instances& instances, std::shared_ptr<Visitor> visitor)
      : eye_(eye),
        instances_(instances),
        visitor_(std::move(visitor)),
        rasterizer_(eye, instances) {
    eye_.begin(probe_.rays);
    for (TileRays& tile : tiles_) eye_.begin(tile.rays);
  }

  void trace_row_of_blocks(int first_row) {
    visitor_->begin_row_of_blocks();
    for (int column = 0; column < eye_.camera().width; column += kBlock) {
      trace_block(column, first_row);
      visitor_->end_block();
    }
  }

 private:
  bool is_in_image(int column, int row) const {
    return column < eye_.camera().width && row < eye_.camera().height;
  }

  void trace_block(int first_column, int first_row) {
    const bool known = start_faces(first_column, first_row, kBlock);
    for (int first = 0; first < kTiles; first += kTilesOfASquare) {
      const int column = first_column + kTile * every_other_bit(first);
      const int row = first_row + kTile * every_other_bit(first >> 1);
      if (!is_in_image(column, row)) continue;
      trace_square(first, column, row, known || start_faces(column, row, kSquare));
    }
  }

  /// Looks for the faces in view of a square, as deep as 16 of its rays go. False if all of its
  /// rays must be traced.
  bool start_faces(int column, int row, int size) {
    if (!eye_.is_linear()) return false;
    eye_.aim(column, row, size / kTile, probe_);
    instances_.find_hits(probe_.valid, {true, false}, RTC_INTERSECT_CONTEXT_FLAG_NONE, probe_.rays);
    float depth = 0.0F;
    for (int i = 0; i < kLanes; ++i) {
      if (probe_.valid[i] != 0) depth = std::max(depth, kDeeper * probe_.rays.ray.tfar[i]);
    }
    return depth < kInexact && rasterizer_.start(column, row, size, depth);
  }

  /// Finds the hits of a square; rays are traced where its faces are not known.
  void trace_square(int first, int first_column, int first_row, bool has_faces) {
    for (int k = 0; k < kTilesOfASquare; ++k) {
      eye_.aim(first_column + kTile * every_other_bit(k),
               first_row + kTile * every_other_bit(k >> 1), 1, tiles_[k]);
    }
    std::array<bool, kTilesOfASquare> found{};
    if (has_faces) rasterizer_.find_hits(first_column, first_row, tiles_, found);
    float depth = 0.0F;
    for (int k = 0; k < kTilesOfASquare; ++k) {
      TileRays& tile = tiles_[k];
      if (!is_in_image(tile.column, tile.row)) continue;
      if (!found[k]) instances_.find_hits(tile.valid, {true, false}, kCoherent, tile.rays);
      for (int i = 0; i < kLanes; ++i) depth = std::max(depth, tile.rays.ray.tfar[i]);
    }
    // Whether movers are in view, and those that are not among the faces.
    bool any = true, other = true;
    if (eye_.is_linear() && depth < kInexact) {
      const Hull view = eye_.hull(first_column, first_row, kSquare, depth);
      any = instances_.any_mover_in(view, [](std::uint32_t) { return true; });
      other = any && instances_.any_mover_in(
                         view, [&](std::uint32_t mover) { return rasterizer_.lacks(mover); });
    }
    for (int k = 0; k < kTilesOfASquare; ++k) {
      TileRays& tile = tiles_[k];
      if (!is_in_image(tile.column, tile.row)) continue;
      if (found[k] ? other : any) {
        instances_.find_hits(tile.valid, {false, true}, kCoherent, tile.rays);
      }
      leave_housing(instances_, static_cast<float>(eye_.camera().far), tile.valid, tile.rays);
      visitor_->add({first + k, tile.column, tile.row, tile.valid, tile.rays});
    }
  }

  const Eye& eye_;
  const Instances& instances_;
  std::shared_ptr<Visitor> visitor_;
  Rasterizer rasterizer_;
  TileRays probe_;
  std::array<TileRays, kTilesOfASquare> tiles_;
};

}  // namespace

void trace(const PinholeCamera& camera, const Pose& pose, const Instances& instances, int threads,
           const std::function<std::unique_ptr<Visitor>()>& make) {
  const Eye eye(camera, pose);
  const int worth = 1 + camera.width * camera.height / kPixelsOfAThread;
  const int rows = (camera.height + kBlock - 1) / kBlock;
  parallel(rows, std::min(threads, worth), [&]() -> std::function<void(int)> {
    auto tracer = std::make_shared<Tracer>(eye, instances, make());
    return [tracer](int row) { tracer->trace_row_of_blocks(row * kBlock); };
  });
}

}  // namespace angen::render
