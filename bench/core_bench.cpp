// The cost of the core without ROS: many sensors, rest, towers, a day. A batch starts in a world
// that has just been loaded, or in an unchanged one.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "worlds.h"

namespace angen::bench {
namespace {

void run(sim::Simulation& simulation, double seconds) {
  const Nanoseconds end = simulation.snapshot()->time + from_seconds(seconds);
  while (simulation.snapshot()->time < end) simulation.tick();
}

double cpu_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Simulated seconds a second of this thread's core.
struct Factor {
  double cpu = cpu_now();
  double simulated = 0.0;
  void report(benchmark::State& state) const {
    state.counters["real_time_factor"] = simulated / (cpu_now() - cpu);
  }
};

/// PIRs of 96 rays at 10 Hz in the rooms of angen.world, and people who walk through them.
void pirs(benchmark::State& state) {
  desc::World world = apartment();
  put_persons(world, static_cast<int>(state.range(1)));
  put_pirs(world, static_cast<int>(state.range(0)));
  const auto simulation = simulate(std::move(world));
  run(*simulation, 6.0);  // until all bodies on the floor are at rest
  Factor factor;
  const std::uint64_t before = simulation->snapshot()->counts.readings;
  for (auto _ : state) {
    run(*simulation, 1.0);
    factor.simulated += 1.0;
  }
  factor.report(state);
  state.counters["readings"] =
      static_cast<double>(simulation->snapshot()->counts.readings - before) / factor.simulated;
}
BENCHMARK(pirs)
    ->ArgNames({"pirs", "people"})
    ->ArgsProduct({{0, 500, 3000, 30000}, {0, 1, 10}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

/// The whole of angen.world as it is: a person, a robot, 50 sensors with noise.
void apartment_as_it_is(benchmark::State& state) {
  const auto simulation = simulate(apartment());
  run(*simulation, 6.0);
  Factor factor;
  for (auto _ : state) {
    run(*simulation, 1.0);
    factor.simulated += 1.0;
  }
  factor.report(state);
}
BENCHMARK(apartment_as_it_is)->Unit(benchmark::kMillisecond)->Iterations(10);

desc::Model door(const desc::World& world) {
  for (const desc::Model& model : world.models) {
    if (model.name.find("_door") != std::string::npos) return model;
  }
  return {};
}

/// An empty world with doors at rest, per tick.
void doors_at_rest(benchmark::State& state) {
  desc::World world = apartment();
  const desc::Model one = door(world);
  world.models.clear();
  for (int i = 0; i < state.range(0); ++i) {
    desc::Model model = one;
    model.name = "bench" + std::to_string(i) + "_door";
    model.pose.position.x() += 3.0 * i;
    world.models.push_back(std::move(model));
  }
  const auto simulation = simulate(std::move(world));
  run(*simulation, 3.0);
  for (auto _ : state) simulation->tick();
}
BENCHMARK(doors_at_rest)->ArgName("doors")->Arg(0)->Arg(100)->Arg(1000);

/// angen.world with a number of floors like its lower one.
desc::World tower(std::int64_t floors) {
  desc::World world = apartment();
  const auto on_ground = [](const desc::Model& model) {
    return model.pose.position.z() < 3.5 && model.name != "elevator" && model.name != "turtlebot" &&
           model.name != "ground_plane" && !is_person(model);
  };
  std::vector<desc::Model> floor;
  std::copy_if(world.models.begin(), world.models.end(), std::back_inserter(floor), on_ground);
  world.models.erase(
      std::remove_if(world.models.begin(), world.models.end(),
                     [&](const desc::Model& model) { return model.pose.position.z() >= 3.5; }),
      world.models.end());
  for (std::int64_t i = 1; i < floors; ++i) {
    for (desc::Model model : floor) {
      const std::string number = std::to_string(i);
      if (!model.name.empty() && model.name.back() == '0') model.name.pop_back();
      model.name += "_" + number;
      model.pose.position.z() += 4.0 * static_cast<double>(i);
      world.models.push_back(std::move(model));
    }
  }
  return world;
}

/// Takes the ticks of a second; counts awake bodies and measures the time of a tick.
void run_seconds(benchmark::State& state, sim::Simulation& simulation) {
  double awake = 0.0;
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i) awake += simulation.tick()->counts.awake_bodies;
  }
  state.counters["awake"] = 1e-3 * awake / static_cast<double>(state.iterations());
  state.counters["us_a_tick"] =
      benchmark::Counter(1e-3 * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Such a tower, a person on the lowest floor, per tick; the rays of its sensors have their noise
/// or none.
void storeys(benchmark::State& state) {
  desc::World world = tower(state.range(0));
  if (state.range(1) == 0) drop_ray_noise(world);
  const auto simulation = simulate(std::move(world));
  run(*simulation, 6.0);
  run_seconds(state, *simulation);
}
BENCHMARK(storeys)
    ->ArgNames({"floors", "noise"})
    ->ArgsProduct({{2, 20, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(10);

/// Ten people a floor who walk one behind the other, or one alone; no sensors. Per tick.
void people(benchmark::State& state) {
  desc::World world = tower(std::max<std::int64_t>(1, state.range(0) / 10));
  drop_sensors(world);
  put_walkers(world, static_cast<int>(state.range(0)));
  const auto simulation = simulate(std::move(world));
  run(*simulation, 6.0);
  Factor factor;
  run_seconds(state, *simulation);
  factor.simulated = static_cast<double>(state.iterations());
  factor.report(state);
}
BENCHMARK(people)
    ->ArgName("people")
    ->Arg(1)
    ->Arg(10)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(12);

/// A person who walks for about `walk` s and then stands for nine times as long.
void let_rest(desc::World& world) {
  const auto person = std::find_if(world.models.begin(), world.models.end(), is_person);
  std::vector<Element>& children = person->plugins[0].element.children;
  const auto is_waypoint = [](const Element& e) { return e.name == "waypoint"; };
  const auto last = std::find_if(children.rbegin(), children.rend(), is_waypoint);
  Element wait = *last;
  const std::size_t space = wait.text.find(' ');
  wait.text = std::to_string(10.0 * std::stod(wait.text)) + wait.text.substr(space);
  children.insert(last.base(), wait);
}

/// An hour of angen.world in which the person moves a tenth of the time; events are gathered.
void an_hour(benchmark::State& state) {
  desc::World world = apartment();
  let_rest(world);
  const auto simulation = simulate(std::move(world));
  Factor factor;
  std::size_t events = 0, ticks = 0;
  for (auto _ : state) {
    const Nanoseconds end = simulation->snapshot()->time + 3600 * kSecond;
    while (simulation->snapshot()->time < end) {
      events += simulation->leap(end)->events.size();
      ++ticks;
    }
    factor.simulated += 3600.0;
  }
  factor.report(state);
  state.counters["s_a_day"] = 86400.0 / factor.simulated * (cpu_now() - factor.cpu);
  state.counters["events"] = static_cast<double>(events);
  state.counters["ticks"] = static_cast<double>(ticks);
}
BENCHMARK(an_hour)->Unit(benchmark::kMillisecond)->Iterations(1);

double thread_cpu_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Commands in second `i`: each lamp is switched at intervals, alone or with all others, doors and
/// the elevator move, and a lit lamp is spawned and deleted.
void use_all(sim::Simulation& simulation, int i) {
  const auto order = [&](const char* kind, const char* name, const char* text) {
    simulation.post(sim::ToDevice{kind, name, {text, {}}});
  };
  static const std::vector<std::string> rooms = {
      "kitchen0", "livingroom0", "bedroom0", "workroom0", "bathroom0", "entrance0",
      "kitchen1", "livingroom1", "bedroom1", "workroom1", "bathroom1", "entrance1"};
  const std::string& room = rooms[static_cast<std::size_t>(i / 5) % rooms.size()];
  if (i % 5 == 0) order("lamp", room.c_str(), i % 120 < 60 ? "On" : "Off");
  if (i % 10 == 3) order("door", room.c_str(), i % 20 == 3 ? "Open" : "Close");
  if (i % 100 == 62) order("lamp", "all", "On");
  if (i % 100 == 71) order("door", "all", "Open");
  if (i % 100 == 81) order("door", "all", "Close");
  if (i % 100 == 92) order("lamp", "all", "Off");
  if (i % 30 == 7) order("elevator", "all", i % 60 == 7 ? "Floor1" : "Floor0");
  if (i % 40 == 20) {
    const std::string lamp =
        "<sdf version='1.9'><model name='bench_lamp'><static>true</static><link name='l'>"
        "<light name='b' type='point'/></link><plugin name='p' filename='libros_plugin.so'>"
        "<level>100</level></plugin></model></sdf>";
    simulation.post(
        sim::Spawn{load::model(lamp, "", {{2, 2, 2.2}, Quat::Identity()}, load::SearchPaths{})});
  }
  if (i % 40 == 35) simulation.post(sim::Delete{"bench_lamp"});
}

/// The CPU time of the longest tick of 10 minutes of angen.world in which everything is used; the
/// first tick is a part of loading.
void longest_tick(benchmark::State& state) {
  const auto simulation = simulate(apartment());
  double first = -thread_cpu_now();
  simulation->tick();
  first += thread_cpu_now();
  double longest = 0.0, longest_at = 0.0;
  int over = 0;
  Factor factor;
  for (auto _ : state) {
    for (int i = 0; i < 600; ++i) {
      use_all(*simulation, i);
      for (int tick = 0; tick < 1000; ++tick) {
        const double before = thread_cpu_now();
        simulation->tick();
        const double took = thread_cpu_now() - before;
        over += took > 0.020 ? 1 : 0;
        if (took <= longest) continue;
        longest = took;
        longest_at = to_seconds(simulation->snapshot()->time);
      }
    }
    factor.simulated += 600.0;
  }
  factor.report(state);
  state.counters["longest_ms"] = 1e3 * longest;
  state.counters["at_s"] = longest_at;
  state.counters["over_20_ms"] = over;
  state.counters["first_ms"] = 1e3 * first;
}
BENCHMARK(longest_tick)->Iterations(1)->Unit(benchmark::kMillisecond);

/// Bytes that a PIR of 96 rays takes, when it has sampled.
void memory_of_a_pir(benchmark::State& state) {
  constexpr int kMany = 4000;
  double bytes = 0.0;
  for (auto _ : state) {
    double resident[2];
    for (const int many : {0, 1}) {
      malloc_trim(0);  // what other cases have left is not to be used again
      desc::World world = apartment();
      put_pirs(world, many * kMany);
      const auto simulation = simulate(std::move(world));
      run(*simulation, 0.3);
      resident[many] = resident_bytes();
    }
    bytes = (resident[1] - resident[0]) / kMany;
  }
  state.counters["bytes"] = bytes;
}
BENCHMARK(memory_of_a_pir)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace angen::bench

BENCHMARK_MAIN();
