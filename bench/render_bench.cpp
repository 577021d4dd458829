// A camera's frame of 320 x 240 in a furnished storey: frames a second on one core.
#include <benchmark/benchmark.h>

#include "render/scene.h"
#include "storey.h"

namespace angen::bench {
namespace {

struct Room {
  Room() {
    for (const Block& block : storey(15, 40)) {
      render::Body body;
      body.surfaces.push_back({block.shape, Pose{}, {0.6F, 0.5F, 0.4F}, Eigen::Vector3f::Zero()});
      body.pose = block.pose;
      body.moves = block.mobility == rays::Mobility::kMoving;
      const render::BodyId id = scene.add(body);
      if (body.moves) movers.emplace_back(id, block.pose);
    }
    for (int i = 0; i < kRoomsAcross * kRoomsDeep; ++i) {
      light::Lit lit;
      lit.lamp.pose.position = room_corner(i) + Vec3(2.0, 2.0, 2.2);
      lit.level = 1.0;
      lamps.push_back(lit);
    }
  }

  render::Scene scene;
  std::vector<std::pair<render::BodyId, Pose>> movers;
  std::vector<light::Lit> lamps;
  render::PinholeCamera lens;
  Pose camera{Vec3(0.3, 0.5, 1.2), from_rpy(0.0, 0.1, 0.8)};
};

void color_frame(benchmark::State& state) {
  Room room;
  room.lamps.resize(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(room.scene.colors(room.lens, room.camera, room.lamps, {}));
  }
}
BENCHMARK(color_frame)
    ->ArgName("lamps")
    ->Arg(0)
    ->Arg(1)
    ->Arg(3)
    ->Arg(6)
    ->Unit(benchmark::kMillisecond);

void depth_frame(benchmark::State& state) {
  const Room room;
  for (auto _ : state) {
    benchmark::DoNotOptimize(room.scene.depths(room.lens, room.camera));
  }
}
BENCHMARK(depth_frame)->Unit(benchmark::kMillisecond);

// As depth_frame, with some of forty movers elsewhere each time.
void depth_frame_after_moves(benchmark::State& state) {
  Room room;
  double turn = 0.0;
  for (auto _ : state) {
    turn += 0.01;
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.range(0)); ++i) {
      const auto& [id, pose] = room.movers[i];
      room.scene.move(id, {pose.position, from_rpy(0.0, 0.0, turn)});
    }
    benchmark::DoNotOptimize(room.scene.depths(room.lens, room.camera));
  }
}
BENCHMARK(depth_frame_after_moves)
    ->ArgName("movers")
    ->Arg(1)
    ->Arg(40)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace angen::bench

BENCHMARK_MAIN();
