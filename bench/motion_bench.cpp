// A tick of angen.world without sensors and people while all its doors, the elevator and the robot
// move, with the same bodies in bare ODE beside.
#include <cmath>

#include "bare_ode.h"
#include "worlds.h"

namespace angen::bench {
namespace {

desc::World without_watchers() {
  desc::World world = apartment();
  drop_persons(world);
  drop_sensors(world);
  return world;
}

/// Doors go to and fro, as does the elevator; the robot drives round.
void keep_moving(sim::Simulation& simulation) {
  const std::int64_t tick = simulation.snapshot()->tick;
  const auto order = [&](const char* kind, Command command) {
    simulation.post(sim::ToDevice{kind, "all", std::move(command)});
  };
  if (tick % 2500 == 0) order("door", {tick % 5000 == 0 ? "Open" : "Close", {}});
  if (tick % 5000 == 0) order("elevator", {tick % 10000 == 0 ? "Floor1" : "Floor0", {}});
  if (tick % 100 == 0) order("drive", {"", {0.1, 0.5}});
}

void building_in_motion(benchmark::State& state) {
  const auto simulation = simulate(without_watchers());
  double awake = 0.0;
  const auto tick = [&] {
    keep_moving(*simulation);
    const auto snapshot = simulation->tick();
    awake += snapshot->counts.awake_bodies;
    for (const sim::Event& event : snapshot->events) {
      if (event.event == "rejected") state.SkipWithError(event.detail.c_str());
    }
  };
  for (int i = 0; i < 6000; ++i) tick();
  awake = 0.0;
  for (auto _ : state) tick();
  state.counters["awake"] = awake / static_cast<double>(state.iterations());
}
BENCHMARK(building_in_motion)->Unit(benchmark::kMicrosecond)->Iterations(20000);

void building_in_bare_ode(benchmark::State& state) {
  BareOde bare(without_watchers());
  std::int64_t tick = 0;
  const auto step = [&] { bare.step(1e-3 * static_cast<double>(tick++), 1e-3); };
  while (tick < 6000) step();
  double awake = 0.0;
  for (auto _ : state) {
    step();
    awake += bare.awake();
  }
  state.counters["awake"] = awake / static_cast<double>(state.iterations());
}
BENCHMARK(building_in_bare_ode)->Unit(benchmark::kMicrosecond)->Iterations(20000);

}  // namespace
}  // namespace angen::bench

BENCHMARK_MAIN();
