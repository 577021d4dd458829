// Light at places that a seed chooses in a world, all lamps lit, beside a path tracer:
//   cmake --build build --target light_places_bench
//   devel/lib/angen_sim/light_places_bench WORLD [SEED [COUNT]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "oracle.h"
#include "sdf/load.h"
#include "sim/engines.h"

namespace angen::bench {
namespace {

constexpr double kShare = 0.02, kLeast = 0.05;        // share of a reading, lx: off beyond both
constexpr double kBefore = 0.002;                     // m, from a place to its surface
constexpr int kBatch = 10'000, kMostPaths = 200'000;  // paths of the tracer

/// Where a walk of one to four steps from a random lamp ends, facing away from that surface.
Pose place(const rays::Scene& scene, const std::vector<light::Lit>& lit, Rng& rng) {
  for (;;) {
    Vec3 at = lit[rng.next() % lit.size()].lamp.pose.position, normal = Vec3::UnitZ();
    normal = light::frame_about(normal) * light::cosine_direction(rng.uniform(), rng.uniform());
    if (rng.uniform() < 0.5) normal = -normal;
    rays::Hit hit;
    for (std::uint64_t steps = 1 + rng.next() % 4; steps > 0; --steps) {
      const double u = rng.uniform(), v = rng.uniform();
      const rays::Ray ray{at, light::frame_about(normal) * light::cosine_direction(u, v), 1e-4};
      scene.cast(&ray, &hit, 1);
      if (!hit.hit()) break;
      normal = hit.normal.cast<double>().normalized();
      at = ray.origin + hit.range * ray.direction;
    }
    const Vec3 before = at + kBefore * normal;
    if (hit.hit() && !scene.covered(before, UINT32_MAX)) {
      return {before, Quat::FromTwoVectors(Vec3::UnitX(), normal)};
    }
  }
}

int run(const char* file, std::uint64_t seed, int count) {
  const desc::World world = load::world(file);
  sim::Engines engines(world, 1);
  for (const desc::Model& model : world.models) {
    for (const sim::Parts::Lamp& lamp : engines.add(model).lamps) {
      engines.light.set_level(lamp.id, 1.0);
    }
  }
  engines.rays.commit();
  const std::vector<light::Lit> lit = engines.light.lit();
  Rng rng(seed, hash_bytes("places"), 0);
  int off = 0, bright = 0, bright_off = 0;
  double worst = 0.0, square = 0.0, sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const Pose at = place(engines.rays, lit, rng);
    light::Probe probe;
    const double lux = engines.light.measure(probe, at).illuminance;
    light::testing::Tracer tracer(engines.rays, lit, at, rng.next());
    double error = 0.0, allowed = 0.0, doubt = 0.0;
    do {  // until it is certain that the place is not off
      tracer.run(kBatch);
      error = std::abs(lux - tracer.mean());
      allowed = std::max(kLeast, kShare * tracer.mean());
      doubt = 3.0 * tracer.deviation();
    } while (tracer.paths() < kMostPaths && error + doubt > allowed);
    const bool is_off = error > allowed;
    const double share = tracer.mean() > 0.0 ? lux / tracer.mean() - 1.0 : 0.0;
    off += is_off;
    if (tracer.mean() > kLeast / kShare) {
      ++bright;
      sum += share;
      square += share * share;
      worst = std::abs(share) > std::abs(worst) ? share : worst;
      bright_off += is_off;
    }
    if (is_off) {
      const Vec3 normal = at.rotation * Vec3::UnitX();
      std::printf("  off at %.3f %.3f %.3f facing %.2f %.2f %.2f: %.3f lx, traced %.3f +- %.3f\n",
                  at.position.x(), at.position.y(), at.position.z(), normal.x(), normal.y(),
                  normal.z(), lux, tracer.mean(), tracer.deviation());
      std::fflush(stdout);
    }
  }
  std::printf("%s, seed %llu: %d of %d places off by more than %.0f %% or %.2f lx\n", file,
              static_cast<unsigned long long>(seed), off, count, 100.0 * kShare, kLeast);
  std::printf("of %d places above %.1f lx: %d off, mean %+.2f %%, rms %.2f %%, worst %+.1f %%\n",
              bright, kLeast / kShare, bright_off, 100.0 * sum / std::max(1, bright),
              100.0 * std::sqrt(square / std::max(1, bright)), 100.0 * worst);
  return 0;
}

}  // namespace
}  // namespace angen::bench

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fprintf(stderr, "usage: light_places_bench WORLD [SEED [COUNT]]\n");
    return 2;
  }
  try {
    return angen::bench::run(argv[1], argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1,
                             argc > 3 ? std::atoi(argv[3]) : 200);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
