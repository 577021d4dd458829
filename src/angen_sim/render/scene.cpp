#include "render/scene.h"

#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/slots.h"
#include "render/reach.h"
#include "render/shade.h"

namespace angen::render {
namespace {

constexpr float kHousing = 0.5F;    // m, in depth: largest distance of a housing's walls
constexpr float kPastWall = 1e-5F;  // m
constexpr int kMaxWalls = 8;

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

/// Calls visit(column, row, valid, rays) for each tile, traced.
template <class Visit>
void trace(const PinholeCamera& camera, const Pose& pose, const Instances& instances,
           Visit&& visit) {
  const Eye eye(camera, pose);
  alignas(64) int valid[kLanes];
  alignas(64) RTCRayHit16 rays;
  eye.begin(rays);
  for (int row = 0; row < camera.height; row += kTile) {
    for (int column = 0; column < camera.width; column += kTile) {
      eye.aim(column, row, valid, rays);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcIntersect16(valid, instances.seen(), &context, &rays);
      leave_housing(instances, static_cast<float>(camera.far), valid, rays);
      visit(column, row, valid, rays);
    }
  }
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

}  // namespace

struct Scene::Impl {
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

Scene::Scene() : impl_(std::make_unique<Impl>()) {}
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
  const Instances& instances = impl_->instances;
  const Eigen::Vector3f ambient = kAmbientIlluminance * ambience.ambient;
  std::vector<std::uint8_t> pixels(3U * static_cast<std::size_t>(camera.width) * camera.height);
  std::vector<Eigen::AlignedBox3f> reaches;
  reaches.reserve(lamps.size());
  for (const light::Lit& lit : lamps) reaches.push_back(impl_->reaches.of(lit.lamp));
  std::optional<light::ReflectedLookup> reflected;
  if (ambience.reflected) {
    reflected.emplace(*ambience.reflected, [&](const auto& from, const auto* to, int count) {
      return seen_from(from, to, count, instances.opaque());
    });
  }
  Tile tile;
  impl_->last = {camera, pose, no_depths(camera)};
  std::vector<float>& depths = impl_->last.depths;
  trace(camera, pose, instances,
        [&](int column, int row, const int* valid, const RTCRayHit16& rays) {
          gather(instances, valid, rays, ambient, tile);
          if (reflected) shine(*reflected, tile);
          const Eigen::AlignedBox3f seen = bounds_of(tile);
          for (std::size_t i = 0; i < lamps.size(); ++i) {
            if (reaches[i].intersects(seen)) shine(lamps[i], instances.opaque(), tile);
          }
          for (int i = 0; i < kLanes; ++i) {
            if (valid[i] == 0) continue;
            const std::size_t at =
                static_cast<std::size_t>(row + i / kTile) * camera.width + column + i % kTile;
            if (tile.valid[i] != 0) {
              depths[at] = rays.ray.tfar[i];
              show(tile, i, &pixels[3 * at]);
            } else {
              for (int c = 0; c < 3; ++c) pixels[3 * at + c] = shown_as_is(ambience.background[c]);
            }
          }
        });
  return pixels;
}

std::vector<float> Scene::depths(const PinholeCamera& camera, const Pose& pose) const {
  impl_->prepare();
  const LastPicture& last = impl_->last;
  if (!last.depths.empty() && equal(last.camera, camera) && last.pose == pose) return last.depths;
  std::vector<float> values = no_depths(camera);
  trace(camera, pose, impl_->instances,
        [&](int column, int row, const int* valid, const RTCRayHit16& rays) {
          for (int i = 0; i < kLanes; ++i) {
            if (valid[i] == 0 || !has_hit(rays, i)) continue;
            values[static_cast<std::size_t>(row + i / kTile) * camera.width + column + i % kTile] =
                rays.ray.tfar[i];
          }
        });
  return values;
}

}  // namespace angen::render
