// The cost of a luminosity reading in a furnished storey with a lamp in each of its six rooms,
// twice.
#include <benchmark/benchmark.h>

#include "light/lighting.h"
#include "storey.h"

namespace angen::bench {
namespace {

struct Lit {
  explicit Lit(int lit) : ids(fill(scene, storey(15, 40))) {
    for (int i = 0; i < 12; ++i) {
      light::Lamp lamp;
      lamp.pose.position = room_corner(i / 2) + Vec3(i % 2 == 0 ? 1.3 : 2.7, 2.0, 2.2);
      lamps.push_back(lighting.add(lamp, i < lit ? 1.0 : 0.0));
    }
  }
  rays::Scene scene;
  std::vector<rays::ShapeId> ids;
  light::Lighting lighting{scene};
  std::vector<light::LampId> lamps;
  Pose sensor{Vec3(0.1, 2.5, 2.0), Quat::Identity()};
};

/// The scene changed since the last reading; the argument is how many of the 12 lamps are lit.
void BM_MeasureChanged(benchmark::State& state) {
  Lit lit(static_cast<int>(state.range(0)));
  light::Probe probe;
  const Pose places[] = {{Vec3(2.0, 2.0, 0.5), Quat::Identity()},
                         {Vec3(2.0, 2.1, 0.5), Quat::Identity()}};
  bool there = false;
  for (auto _ : state) {
    there = !there;
    lit.scene.move(lit.ids.back(), places[there ? 1 : 0]);
    lit.scene.commit();
    benchmark::DoNotOptimize(lit.lighting.measure(probe, lit.sensor));
  }
}

void BM_MeasureUnchanged(benchmark::State& state) {
  Lit lit(12);
  light::Probe probe;
  for (auto _ : state) benchmark::DoNotOptimize(lit.lighting.measure(probe, lit.sensor));
}

void BM_MeasureDimmed(benchmark::State& state) {
  Lit lit(12);
  light::Probe probe;
  double level = 0.5;
  for (auto _ : state) {
    level = level == 0.5 ? 0.6 : 0.5;
    lit.lighting.set_level(lit.lamps.front(), level);
    benchmark::DoNotOptimize(lit.lighting.measure(probe, lit.sensor));
  }
}

BENCHMARK(BM_MeasureChanged)->Arg(1)->Arg(4)->Arg(12)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_MeasureUnchanged);
BENCHMARK(BM_MeasureDimmed);

}  // namespace
}  // namespace angen::bench

BENCHMARK_MAIN();
