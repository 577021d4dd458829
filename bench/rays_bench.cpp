// Rays through `rays`, with raw Embree beside: the same boxes as triangles, the same two scenes and
// flags, one ray a call.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <memory>

#include "storey.h"

namespace angen::bench {
namespace {

constexpr int kFurniture = 15;  // a room
constexpr int kMovers = 40;

/// The rays of a PIR: 96 of 6 m, 24 across 110 degrees and 4 down 40, from a corner of each
/// room.
std::vector<rays::Ray> pir_rays() {
  std::vector<rays::Ray> all;
  for (int room = 0; room < kRoomsAcross * kRoomsDeep; ++room) {
    for (int i = 0; i < 24; ++i) {
      for (int j = 0; j < 4; ++j) {
        rays::Ray ray;
        ray.origin = room_corner(room) + Vec3(0.2, 0.2, 2.3);
        const double yaw = (45 + 110 * (i / 23.0 - 0.5)) * M_PI / 180;
        const double pitch = (5 + 40 * j / 3.0) * M_PI / 180;
        ray.direction = {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                         -std::sin(pitch)};
        ray.max = 6.0;
        all.push_back(ray);
      }
    }
  }
  return all;
}

std::vector<rays::Ray> random_rays() {
  Rng rng(2, hash_bytes("random rays"), 0);
  std::vector<rays::Ray> all(1000);
  for (rays::Ray& ray : all) {
    const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
    const double u = rng.gaussian(), v = rng.gaussian(), w = rng.gaussian();
    ray.origin = {12 * x, 8 * y, 2.5 * z};
    ray.direction = Vec3(u, v, w).normalized();
    ray.max = 6.0;
  }
  return all;
}

struct RawScene {
  RTCScene scene;
  RawScene(RTCDevice device, const std::vector<Block>& blocks, rays::Mobility mobility)
      : scene(rtcNewScene(device)) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    for (const Block& b : blocks) {
      if (b.mobility == mobility) attach(device, b);
    }
    rtcCommitScene(scene);
  }
  ~RawScene() { rtcReleaseScene(scene); }
  RawScene(const RawScene&) = delete;
  RawScene& operator=(const RawScene&) = delete;

  void attach(RTCDevice device, const Block& b) {
    static constexpr unsigned kSides[36] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                            2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 8));
    for (int i = 0; i < 8; ++i) {
      const Vec3 sign((i & 4) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                      (i & 1) != 0 ? 0.5 : -0.5);
      const Vec3 corner = b.pose * Vec3(sign.cwiseProduct(b.shape.size));
      for (int axis = 0; axis < 3; ++axis) corners[3 * i + axis] = static_cast<float>(corner[axis]);
    }
    auto* sides = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 12));
    std::copy(std::begin(kSides), std::end(kSides), sides);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
};

void BM_Ours(benchmark::State& state, std::vector<rays::Ray> (*make)()) {
  rays::Scene scene;
  fill(scene, storey(kFurniture, kMovers));
  const std::vector<rays::Ray> rays = make();
  std::vector<rays::Hit> hits(rays.size());
  for (auto _ : state) {
    scene.cast(rays.data(), hits.data(), rays.size());
    benchmark::DoNotOptimize(hits.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void BM_RawEmbree(benchmark::State& state, std::vector<rays::Ray> (*make)()) {
  const RTCDevice device = rtcNewDevice("threads=1");
  {
    const std::vector<Block> blocks = storey(kFurniture, kMovers);
    const RawScene fixed(device, blocks, rays::Mobility::kStatic);
    const RawScene moving(device, blocks, rays::Mobility::kMoving);
    const std::vector<rays::Ray> rays = make();
    std::vector<float> ranges(rays.size());
    for (auto _ : state) {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        const Eigen::Vector3f o = rays[i].origin.cast<float>(), d = rays[i].direction.cast<float>();
        RTCRayHit hit{};
        hit.ray = {o.x(), o.y(), o.z(), 0, d.x(), d.y(), d.z(), 0, 6.0F, UINT32_MAX, 0, 0};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(fixed.scene, &context, &hit);
        rtcIntersect1(moving.scene, &context, &hit);
        ranges[i] = hit.ray.tfar;
      }
      benchmark::DoNotOptimize(ranges.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
  }
  rtcReleaseDevice(device);
}

/// All movers have moved: the cost of a commit.
void BM_Commit(benchmark::State& state) {
  rays::Scene scene;
  const std::vector<Block> blocks = storey(kFurniture, static_cast<int>(state.range(0)));
  const std::vector<rays::ShapeId> ids = fill(scene, blocks);
  double shift = 0.0;
  for (auto _ : state) {
    shift = shift == 0.0 ? 0.01 : 0.0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (blocks[i].mobility != rays::Mobility::kMoving) continue;
      scene.move(ids[i], {blocks[i].pose.position + Vec3(shift, 0, 0), blocks[i].pose.rotation});
    }
    scene.commit();
  }
}

void BM_Blocked(benchmark::State& state) {
  rays::Scene scene;
  fill(scene, storey(kFurniture, kMovers));
  const std::vector<rays::Ray> rays = random_rays();
  const Vec3 lamp(6, 2, 2.2);
  for (auto _ : state) {
    int count = 0;
    for (const rays::Ray& ray : rays) count += scene.blocked(ray.origin, lamp) ? 1 : 0;
    benchmark::DoNotOptimize(count);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

BENCHMARK_CAPTURE(BM_Ours, pir, pir_rays);
BENCHMARK_CAPTURE(BM_RawEmbree, pir, pir_rays);
BENCHMARK_CAPTURE(BM_Ours, random, random_rays);
BENCHMARK_CAPTURE(BM_RawEmbree, random, random_rays);
BENCHMARK(BM_Blocked);
BENCHMARK(BM_Commit)->Arg(40)->Arg(400);

}  // namespace
}  // namespace angen::bench

BENCHMARK_MAIN();
