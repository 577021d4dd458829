#include "render/tracer.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/parallel.h"

namespace angen::render {
namespace {

constexpr float kHousing = 0.5F;    // m, in depth: largest distance of a housing's walls
constexpr float kPastWall = 1e-5F;  // m
constexpr int kMaxWalls = 8;
constexpr auto kCoherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
constexpr int kTilesOfASquare = 16;        // whose movers are looked for at once
constexpr int kSquare = 4 * kTile;         // pixels
constexpr double kInexact = 1e5;           // m; hulls are inexact beyond
constexpr int kPixelsOfAThread = 1 << 13;  // fewer are not worth its start

/// Bits 0, 2, 4, … as bits 0, 1, 2, …
int every_other_bit(int of) {
  int bits = 0;
  for (int i = 0; i < kDivisions; ++i) bits |= (of >> (2 * i) & 1) << i;
  return bits;
}

/// The camera's rays, one tile at a time. The length of a direction makes its range the depth.
class Eye {
 public:
  Eye(const PinholeCamera& camera, const Pose& pose)
      : camera_(camera), origin_(pose.position.cast<float>()) {
    const Eigen::Matrix3d rotation = pose.rotation.normalized().toRotationMatrix();
    ahead_ = rotation.col(0);
    right_ = -rotation.col(1) / camera.focal();
    down_ = -rotation.col(2) / camera.focal();
    for (int x = 0; x < camera.width + kBlock; ++x) {
      columns_.push_back(ahead_ + (x - camera.center_x()) * right_);
    }
  }

  /// Sets the values that all tiles share.
  void begin(RTCRayHit16& rays) const {
    for (int i = 0; i < kLanes; ++i) {
      rays.ray.org_x[i] = origin_.x();
      rays.ray.org_y[i] = origin_.y();
      rays.ray.org_z[i] = origin_.z();
      rays.ray.time[i] = 0.0F;
      rays.ray.mask[i] = UINT32_MAX;
      rays.ray.id[i] = 0;
      rays.ray.flags[i] = 0;
    }
  }

  /// False only if the rays of the square at that pixel meet no mover up to that depth.
  bool may_meet_movers(int column, int row, float depth, const Instances& instances) const {
    if (!camera_.distortion.none() || !(depth < kInexact)) return true;
    Box ends;
    for (const int x : {column, column + kSquare - 1}) {
      for (const int y : {row, row + kSquare - 1}) {
        ends.extend(origin_ + depth * toward(x, y).cast<float>());
      }
    }
    return instances.has_mover_in(Hull(Box(origin_), ends));
  }

  void aim(int column, int row, int* valid, RTCRayHit16& rays) const {
    for (int i = 0; i < kLanes; ++i) {
      valid[i] = column + i % kTile < camera_.width && row + i / kTile < camera_.height ? -1 : 0;
      rays.ray.tnear[i] = static_cast<float>(camera_.near);
      rays.ray.tfar[i] = static_cast<float>(camera_.far);
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const Eigen::Vector3f direction = toward(column + x, row + y).cast<float>();
        rays.ray.dir_x[kTile * y + x] = direction.x();
        rays.ray.dir_y[kTile * y + x] = direction.y();
        rays.ray.dir_z[kTile * y + x] = direction.z();
      }
    }
  }

 private:
  Vec3 toward(int column, int row) const {
    double y = row - camera_.center_y();
    if (camera_.distortion.none()) return columns_[static_cast<std::size_t>(column)] + y * down_;
    double x = column - camera_.center_x();
    const double focal = camera_.focal();
    camera_.distortion.undistort(x / focal, y / focal, x, y);
    return ahead_ + x * focal * right_ + y * focal * down_;
  }

  const PinholeCamera& camera_;
  Eigen::Vector3f origin_;
  Vec3 ahead_, right_, down_;
  std::vector<Vec3> columns_;  // the directions at the height of the axis
};

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

struct alignas(64) TileRays {
  int valid[kLanes];
  RTCRayHit16 rays;
  int column, row;
};

/// The work of one thread.
class Tracer {
 public:
  Tracer(const Eye& eye, const PinholeCamera& camera, const Instances& instances,
         std::shared_ptr<Visitor> visitor)
      : eye_(eye), camera_(camera), instances_(instances), visitor_(std::move(visitor)) {
    for (TileRays& tile : tiles_) eye_.begin(tile.rays);
  }

  void trace_row_of_blocks(int first_row) {
    visitor_->begin_row_of_blocks();
    for (int column = 0; column < camera_.width; column += kBlock) {
      trace_block(column, first_row);
      visitor_->end_block();
    }
  }

 private:
  void trace_block(int first_column, int first_row) {
    for (int first = 0; first < kTiles; first += kTilesOfASquare) {
      const int column = first_column + kTile * every_other_bit(first);
      const int row = first_row + kTile * every_other_bit(first >> 1);
      if (column < camera_.width && row < camera_.height) trace_square(first, column, row);
    }
  }

  /// Traces the fixed bodies first: most squares show no mover in front of them.
  void trace_square(int first, int first_column, int first_row) {
    float depth = 0.0F;
    for (int k = 0; k < kTilesOfASquare; ++k) {
      TileRays& tile = tiles_[k];
      tile.column = first_column + kTile * every_other_bit(k);
      tile.row = first_row + kTile * every_other_bit(k >> 1);
      if (tile.column >= camera_.width || tile.row >= camera_.height) continue;
      eye_.aim(tile.column, tile.row, tile.valid, tile.rays);
      instances_.find_hits(tile.valid, {true, false}, kCoherent, tile.rays);
      for (int i = 0; i < kLanes; ++i) depth = std::max(depth, tile.rays.ray.tfar[i]);
    }
    const bool movers = eye_.may_meet_movers(first_column, first_row, depth, instances_);
    for (int k = 0; k < kTilesOfASquare; ++k) {
      TileRays& tile = tiles_[k];
      if (tile.column >= camera_.width || tile.row >= camera_.height) continue;
      if (movers) instances_.find_hits(tile.valid, {false, true}, kCoherent, tile.rays);
      leave_housing(instances_, static_cast<float>(camera_.far), tile.valid, tile.rays);
      visitor_->add({first + k, tile.column, tile.row, tile.valid, tile.rays});
    }
  }

  const Eye& eye_;
  const PinholeCamera& camera_;
  const Instances& instances_;
  std::shared_ptr<Visitor> visitor_;
  std::array<TileRays, kTilesOfASquare> tiles_;
};

}  // namespace

void trace(const PinholeCamera& camera, const Pose& pose, const Instances& instances, int threads,
           const std::function<std::unique_ptr<Visitor>()>& make) {
  const Eye eye(camera, pose);
  const int worth = 1 + camera.width * camera.height / kPixelsOfAThread;
  const int rows = (camera.height + kBlock - 1) / kBlock;
  parallel(rows, std::min(threads, worth), [&]() -> std::function<void(int)> {
    auto tracer = std::make_shared<Tracer>(eye, camera, instances, make());
    return [tracer](int row) { tracer->trace_row_of_blocks(row * kBlock); };
  });
}

}  // namespace angen::render
