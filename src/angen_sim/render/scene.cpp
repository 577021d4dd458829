#include "render/scene.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/parallel.h"
#include "core/slots.h"
#include "render/reach.h"
#include "render/shade.h"

namespace angen::render {
namespace {

constexpr float kHousing = 0.5F;    // m, in depth: largest distance of a housing's walls
constexpr float kPastWall = 1e-5F;  // m
constexpr int kMaxWalls = 8;
constexpr int kPixelsOfAThread = 1 << 13;  // fewer are not worth its start

struct Entry {
  Body body;
  std::uint32_t number = 0;  // in the instances, of a body with its own patch
  bool moved = false;
};

bool alone(const Body& body) { return body.moves || body.holds_lamp; }

/// The camera's rays, one tile at a time. The length of a direction makes its range the depth.
class Eye {
 public:
  Eye(const PinholeCamera& camera, const Pose& pose)
      : camera_(camera), origin_(pose.position.cast<float>()) {
    const Eigen::Matrix3d rotation = pose.rotation.normalized().toRotationMatrix();
    ahead_ = rotation.col(0);
    right_ = -rotation.col(1) / camera.focal();
    down_ = -rotation.col(2) / camera.focal();
    for (int x = 0; x < camera.width + kTile; ++x) {
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

bool has_hit(const RTCRayHit16& rays, int i) {
  return rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
}

Eigen::Vector3f direction_of(const RTCRay16& ray, int i) {
  return {ray.dir_x[i], ray.dir_y[i], ray.dir_z[i]};
}

bool equal(const PinholeCamera& a, const PinholeCamera& b) {
  const auto numbers = [](const PinholeCamera& camera) {
    const Distortion& d = camera.distortion;
    return std::make_tuple(camera.width, camera.height, camera.horizontal_angle, camera.near,
                           camera.far, d.k1, d.k2, d.p1, d.p2, d.k3);
  };
  return numbers(a) == numbers(b);
}

/// The hits of the last color image: depths of the same camera are usually requested next.
struct LastPicture {
  PinholeCamera camera;
  Pose pose;
  std::vector<float> depths;  // empty: none, or outdated
};

std::vector<float> no_depths(const PinholeCamera& camera) {
  return std::vector<float>(static_cast<std::size_t>(camera.width) * camera.height,
                            std::numeric_limits<float>::quiet_NaN());
}

Facet facet_of(const RTCRayHit16& rays, int i, const Placed& placed) {
  return placed.patch->facet(rays.hit.geomID[i], rays.hit.primID[i]);
}

/// Continues rays that have hit a near surface from behind: many cameras are inside their own
/// housing, which renderers that cull back faces do not show.
void leave_housing(const Instances& instances, float far, const int* valid, RTCRayHit16& rays) {
  alignas(64) int inside[kLanes];
  for (int walls = 0; walls < kMaxWalls; ++walls) {
    bool any = false;
    for (int i = 0; i < kLanes; ++i) {
      inside[i] = 0;
      if (valid[i] == 0 || !has_hit(rays, i) || rays.ray.tfar[i] > kHousing) continue;
      const Placed& placed = instances[rays.hit.instID[0][i]];
      const Eigen::Vector3f normal = placed.rotation * facet_of(rays, i, placed).normal;
      if (normal.dot(direction_of(rays.ray, i)) <= 0.0F) continue;
      inside[i] = -1;
      any = true;
      rays.ray.tnear[i] = rays.ray.tfar[i] + kPastWall;
      rays.ray.tfar[i] = far;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!any) return;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(inside, instances.seen(), &context, &rays);
  }
}

/// Traces all tiles, a strip of them at a time, on several threads. Each thread makes its own
/// visitor with `make`; it is called as visit(strip) before a strip's tiles, and as
/// visit(column, row, valid, rays) for each tile.
template <class Make>
void trace(const PinholeCamera& camera, const Pose& pose, const Instances& instances, int threads,
           const Make& make) {
  const Eye eye(camera, pose);
  const int worth = 1 + camera.width * camera.height / kPixelsOfAThread;
  const int strips = (camera.height + kTile - 1) / kTile;
  parallel(strips, std::min(threads, worth), [&]() -> std::function<void(int)> {
    return [&, visit = make()](int strip) mutable {
      alignas(64) int valid[kLanes];
      alignas(64) RTCRayHit16 rays;
      eye.begin(rays);
      visit(strip);
      for (int column = 0; column < camera.width; column += kTile) {
        eye.aim(column, strip * kTile, valid, rays);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(valid, instances.seen(), &context, &rays);
        leave_housing(instances, static_cast<float>(camera.far), valid, rays);
        visit(column, strip * kTile, valid, rays);
      }
    };
  });
}

/// Box around the hits of a tile; empty without hits.
Eigen::AlignedBox3f bounds_of(const Tile& tile) {
  Eigen::AlignedBox3f box;
  for (int i = 0; i < kLanes; ++i) {
    if (tile.valid[i] != 0) box.extend(tile.point[i]);
  }
  return box;
}

void gather(const Instances& instances, const int* valid, const RTCRayHit16& rays,
            const Eigen::Vector3f& ambient, Tile& tile) {
  for (int i = 0; i < kLanes; ++i) {
    tile.valid[i] = valid[i] != 0 && has_hit(rays, i) ? -1 : 0;
    if (tile.valid[i] == 0) continue;
    const Placed& placed = instances[rays.hit.instID[0][i]];
    const Facet facet = facet_of(rays, i, placed);
    const Eigen::Vector3f direction = direction_of(rays.ray, i);
    const Eigen::Vector3f origin(rays.ray.org_x[i], rays.ray.org_y[i], rays.ray.org_z[i]);
    tile.point[i] = origin + rays.ray.tfar[i] * direction;
    tile.normal[i] = placed.rotation * facet.normal;
    if (tile.normal[i].dot(direction) > 0.0F) tile.normal[i] = -tile.normal[i];
    tile.through[i] = placed.shines_through;
    tile.finish[i] = &placed.patch->finish(facet);
    tile.color[i] = placed.patch->color(facet, rays.hit.u[i], rays.hit.v[i]);
    tile.light[i] = ambient;
  }
}

void show(const Tile& tile, int i, std::uint8_t* pixel) {
  const Finish& finish = *tile.finish[i];
  for (int c = 0; c < 3; ++c) {
    const float reflected = tile.color[i][c] * tile.light[i][c] / static_cast<float>(M_PI);
    pixel[c] = shown(reflected + kMiddleLuminance * finish.emissive[c]);
  }
}

std::size_t index_of(const PinholeCamera& camera, int column, int row, int lane) {
  return static_cast<std::size_t>(row + lane / kTile) * camera.width + column + lane % kTile;
}

/// Writes the depths of tiles.
struct DepthWriter {
  void operator()(int) const {}
  void operator()(int column, int row, const int* valid, const RTCRayHit16& rays) const {
    for (int i = 0; i < kLanes; ++i) {
      if (valid[i] == 0 || !has_hit(rays, i)) continue;
      depths[index_of(camera, column, row, i)] = rays.ray.tfar[i];
    }
  }

  const PinholeCamera& camera;
  float* depths;
};

/// The light of an image.
struct Illumination {
  const std::vector<light::Lit>& lamps;
  const std::vector<Eigen::AlignedBox3f>& reaches;  // of the lamps
  const Ambience& ambience;
};

/// Writes the colors of tiles, and their depths.
class ColorWriter {
 public:
  ColorWriter(const Instances& instances, const Illumination& by, const DepthWriter& depths,
              std::uint8_t* pixels)
      : instances_(instances), by_(by), depths_(depths), pixels_(pixels) {
    if (!by.ambience.reflected) return;
    reflected_.emplace(*by.ambience.reflected, instances.opaque());
  }

  void operator()(int) {
    if (reflected_) reflected_->start();
  }
  void operator()(int column, int row, const int* valid, const RTCRayHit16& rays) {
    Tile tile;
    gather(instances_, valid, rays, kAmbientIlluminance * by_.ambience.ambient, tile);
    if (reflected_) reflected_->shine(tile);
    const Eigen::AlignedBox3f seen = bounds_of(tile);
    for (std::size_t i = 0; i < by_.lamps.size(); ++i) {
      if (by_.reaches[i].intersects(seen)) shine(by_.lamps[i], instances_.opaque(), tile);
    }
    for (int i = 0; i < kLanes; ++i) {
      if (valid[i] == 0) continue;
      std::uint8_t* pixel = pixels_ + 3 * index_of(depths_.camera, column, row, i);
      if (tile.valid[i] != 0) {
        show(tile, i, pixel);
      } else {
        for (int c = 0; c < 3; ++c) pixel[c] = shown_as_is(by_.ambience.background[c]);
      }
    }
    depths_(column, row, valid, rays);
  }

 private:
  const Instances& instances_;
  const Illumination& by_;
  DepthWriter depths_;
  std::uint8_t* pixels_;
  std::optional<Reflections> reflected_;
};

}  // namespace

struct Scene::Impl {
  int threads;
  Slots<Entry, BodyTag> entries;
  Instances instances;
  Reaches reaches;      // of lamps among the bodies that do not move
  bool new_set = true;  // bodies were added or removed
  bool moved = false;
  LastPicture last;

  void rebuild() {
    instances.clear();
    std::vector<std::pair<const Body*, Pose>> still;
    entries.each([&](BodyId, Entry& entry) {
      entry.moved = false;
      if (!alone(entry.body)) {
        still.emplace_back(&entry.body, entry.body.pose);
      } else {
        auto patch = std::make_unique<Patch>(
            std::vector<std::pair<const Body*, Pose>>{{&entry.body, Pose{}}});
        entry.number = instances.add(std::move(patch), entry.body.pose, !entry.body.holds_lamp);
      }
    });
    const std::uint32_t fixed = instances.add(std::make_unique<Patch>(still), Pose{}, true);
    reaches.start(instances[fixed].patch->scene());
  }

  void prepare() {
    if (!new_set && !moved) return;
    last.depths.clear();
    if (new_set) {
      rebuild();
    } else {
      entries.each([&](BodyId, Entry& entry) {
        if (std::exchange(entry.moved, false)) instances.place(entry.number, entry.body.pose);
      });
    }
    instances.commit();
    new_set = moved = false;
  }
};

Scene::Scene(int threads) : impl_(std::make_unique<Impl>()) {
  impl_->threads = threads > 0 ? threads : processors();
}
Scene::~Scene() = default;

BodyId Scene::add(Body body) {
  impl_->new_set = true;
  return impl_->entries.add({std::move(body)});
}

void Scene::move(BodyId body, const Pose& pose) {
  Entry& entry = impl_->entries.at(body);
  if (entry.body.pose == pose) return;
  entry.body.pose = pose;
  entry.moved = impl_->moved = true;
  if (!alone(entry.body)) impl_->new_set = true;
}

void Scene::remove(BodyId body) {
  impl_->entries.remove(body);
  impl_->new_set = true;
}

std::vector<std::uint8_t> Scene::colors(const PinholeCamera& camera, const Pose& pose,
                                        const std::vector<light::Lit>& lamps,
                                        const Ambience& ambience) const {
  impl_->prepare();
  std::vector<std::uint8_t> pixels(3U * static_cast<std::size_t>(camera.width) * camera.height);
  std::vector<Eigen::AlignedBox3f> reaches;
  reaches.reserve(lamps.size());
  for (const light::Lit& lit : lamps) reaches.push_back(impl_->reaches.of(lit.lamp));
  const Illumination by{lamps, reaches, ambience};
  impl_->last = {camera, pose, no_depths(camera)};
  const DepthWriter depths{camera, impl_->last.depths.data()};
  trace(camera, pose, impl_->instances, impl_->threads,
        [&] { return ColorWriter(impl_->instances, by, depths, pixels.data()); });
  return pixels;
}

std::vector<float> Scene::depths(const PinholeCamera& camera, const Pose& pose) const {
  impl_->prepare();
  const LastPicture& last = impl_->last;
  if (!last.depths.empty() && equal(last.camera, camera) && last.pose == pose) return last.depths;
  std::vector<float> values = no_depths(camera);
  trace(camera, pose, impl_->instances, impl_->threads, [&] {
    return DepthWriter{camera, values.data()};
  });
  return values;
}

}  // namespace angen::render
