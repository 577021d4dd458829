#include "render/tracer.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"

namespace angen::render {
namespace {

constexpr float kHousing = 0.5F;    // m, in depth: largest distance of a housing's walls
constexpr float kPastWall = 1e-5F;  // m
constexpr int kMaxWalls = 8;
constexpr double kFarAway = 1e5;           // m; hulls are inexact beyond
constexpr int kPixelsOfAThread = 1 << 13;  // fewer are not worth its start

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

  /// False only if the rays of the block at that pixel meet no mover.
  bool may_meet_movers(int column, int row, const Instances& instances) const {
    if (!camera_.distortion.none() || !(camera_.far < kFarAway)) return true;
    Box ends;
    for (const int x : {column, column + kBlock - 1}) {
      for (const int y : {row, row + kBlock - 1}) {
        ends.extend(origin_ + (camera_.far * toward(x, y)).cast<float>());
      }
    }
    return instances.has_mover_in(Hull(Box(origin_), ends));
  }

  void aim(int column, int row, int* valid, RTCRayHit16& rays) const {
    for (int i = 0; i < kLanes; ++i) {
      const int x = column + i % kTile;
      const int y = row + i / kTile;
      valid[i] = x < camera_.width && y < camera_.height ? -1 : 0;
      const Eigen::Vector3f direction = toward(x, y).cast<float>();
      rays.ray.dir_x[i] = direction.x();
      rays.ray.dir_y[i] = direction.y();
      rays.ray.dir_z[i] = direction.z();
      rays.ray.tnear[i] = static_cast<float>(camera_.near);
      rays.ray.tfar[i] = static_cast<float>(camera_.far);
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
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

/// The work of one thread.
class Tracer {
 public:
  Tracer(const Eye& eye, const PinholeCamera& camera, const Instances& instances,
         std::shared_ptr<Visitor> visitor)
      : eye_(eye), camera_(camera), instances_(instances), visitor_(std::move(visitor)) {
    eye_.begin(rays_);
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
    const int columns = std::min(camera_.width, first_column + kBlock);
    const int rows = std::min(camera_.height, first_row + kBlock);
    const Among among{true, eye_.may_meet_movers(first_column, first_row, instances_)};
    for (int row = first_row; row < rows; row += kTile) {
      for (int column = first_column; column < columns; column += kTile) {
        eye_.aim(column, row, valid_, rays_);
        instances_.find_hits(valid_, among, RTC_INTERSECT_CONTEXT_FLAG_COHERENT, rays_);
        leave_housing(instances_, static_cast<float>(camera_.far), valid_, rays_);
        visitor_->add({column, row, valid_, rays_});
      }
    }
  }

  const Eye& eye_;
  const PinholeCamera& camera_;
  const Instances& instances_;
  std::shared_ptr<Visitor> visitor_;
  alignas(64) int valid_[kLanes];
  alignas(64) RTCRayHit16 rays_;
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
