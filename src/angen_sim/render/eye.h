#pragma once

#include <vector>

#include "render/hull.h"
#include "render/pinhole_camera.h"
#include "render/tracer.h"

namespace angen::render {

/// The rays of a tile with its place in the image.
struct alignas(64) TileRays {
  int valid[kLanes];
  RTCRayHit16 rays;
  int column, row;
};

/// The camera's rays. The length of a direction makes its range the depth.
class Eye {
 public:
  Eye(const PinholeCamera& camera, const Pose& pose);

  const PinholeCamera& camera() const { return camera_; }
  const Eigen::Vector3f& origin() const { return origin_; }
  /// Whether directions are linear in the pixel.
  bool is_linear() const { return is_linear_; }
  Vec3 toward(int column, int row) const;
  /// Around the rays of a square of pixels up to that depth, if they are linear.
  Hull hull(int column, int row, int size, float depth) const;

  /// Sets the values that all tiles share.
  void begin(RTCRayHit16& rays) const;
  /// Sets the rays of every n-th pixel of a square of 4 x 4 of these.
  void aim(int column, int row, int every, TileRays& tile) const;

 private:
  const PinholeCamera& camera_;
  bool is_linear_;
  Eigen::Vector3f origin_;
  Vec3 ahead_, right_, down_;
  std::vector<Vec3> columns_;  // the directions at the height of the axis
};

}  // namespace angen::render
