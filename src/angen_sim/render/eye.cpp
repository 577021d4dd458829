#include "render/eye.h"

namespace angen::render {

Eye::Eye(const PinholeCamera& camera, const Pose& pose)
    : camera_(camera), is_linear_(camera.distortion.none()), origin_(pose.position.cast<float>()) {
  const Eigen::Matrix3d rotation = pose.rotation.normalized().toRotationMatrix();
  ahead_ = rotation.col(0);
  right_ = -rotation.col(1) / camera.focal();
  down_ = -rotation.col(2) / camera.focal();
  for (int x = 0; x < camera.width + kBlock; ++x) {
    columns_.push_back(ahead_ + (x - camera.center_x()) * right_);
  }
}

Vec3 Eye::toward(int column, int row) const {
  double y = row - camera_.center_y();
  if (is_linear()) return columns_[static_cast<std::size_t>(column)] + y * down_;
  double x = column - camera_.center_x();
  const double focal = camera_.focal();
  camera_.distortion.undistort(x / focal, y / focal, x, y);
  return ahead_ + x * focal * right_ + y * focal * down_;
}

Hull Eye::hull(int column, int row, int size, float depth) const {
  Box ends;
  for (const int x : {column, column + size - 1}) {
    for (const int y : {row, row + size - 1}) {
      ends.extend(origin_ + depth * toward(x, y).cast<float>());
    }
  }
  return {Box(origin_), ends};
}

void Eye::begin(RTCRayHit16& rays) const {
  for (int i = 0; i < kLanes; ++i) {
    rays.ray.org_x[i] = origin_.x();
    rays.ray.org_y[i] = origin_.y();
    rays.ray.org_z[i] = origin_.z();
    rays.ray.time[i] = 0.0F;
    rays.ray.mask[i] = UINT32_MAX;
    rays.ray.id[i] = 0;
    rays.ray.flags[i] = 0;
    rays.hit.u[i] = rays.hit.v[i] = 0.0F;
  }
}

void Eye::aim(int column, int row, int every, TileRays& tile) const {
  RTCRayHit16& rays = tile.rays;
  tile.column = column;
  tile.row = row;
  for (int i = 0; i < kLanes; ++i) {
    const int x = column + every * (i % kTile), y = row + every * (i / kTile);
    tile.valid[i] = x < camera_.width && y < camera_.height ? -1 : 0;
    rays.ray.tnear[i] = static_cast<float>(camera_.near);
    rays.ray.tfar[i] = static_cast<float>(camera_.far);
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    const Eigen::Vector3f direction = toward(x, y).cast<float>();
    rays.ray.dir_x[i] = direction.x();
    rays.ray.dir_y[i] = direction.y();
    rays.ray.dir_z[i] = direction.z();
  }
}

}  // namespace angen::render
