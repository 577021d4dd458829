#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/param.h>
#include <signal.h>

#include <atomic>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "load/load.h"
#include "plugin/library.h"
#include "ros/node.h"
#include "sim/simulation.h"

namespace {

using angen::sim::Simulation;

constexpr char kUsage[] =
    "usage: angen_node [WORLD] [_rate:=1] [_paused:=false] [_seed:=1] [_clock_rate:=100]\n"
    "                  [_fast:=false] [_topics:=sensor|kind]\n"
    "       angen_node --check WORLD    only loads; exit code 1 when it cannot\n"
    "WORLD may also stand in the parameter ~world.\n";

std::atomic<bool> stop{false};

void on_signal(int) { stop = true; }

void end_on_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

/// Throws Error for what does not load; warnings go to stderr.
angen::desc::World read(const std::string& path) {
  angen::desc::World world = angen::load::world(path);
  for (const angen::Diagnostic& warning : world.warnings) {
    std::fprintf(stderr, "%s\n", warning.text().c_str());
  }
  return world;
}

std::unique_ptr<Simulation> make(angen::desc::World world, std::uint64_t seed) {
  return std::make_unique<Simulation>(std::move(world), seed, std::make_shared<angen::Catalog>());
}

std::string summary(const std::string& path, const Simulation& simulation) {
  const angen::sim::Structure& structure = *simulation.snapshot()->structure;
  return path + ": " + std::to_string(structure.models.size()) + " models, " +
         std::to_string(structure.devices.size()) + " devices, " +
         std::to_string(structure.sensors.size()) + " sensors";
}

int check(const std::string& path) {
  std::printf("%s\n", summary(path, *make(read(path), 1)).c_str());
  return EXIT_SUCCESS;
}

double number_param(const std::string& name, double fallback, double least) {
  double value = fallback;
  if (ros::param::has(name) && !ros::param::get(name, value)) {
    throw angen::Error(name + " must be a number");
  }
  if (!(value >= least) || !std::isfinite(value)) {
    throw angen::Error(name + " is " + std::to_string(value) + ", must be at least " +
                       std::to_string(least));
  }
  return value;
}

int run(std::string path, std::optional<angen::desc::World> world) {
  if (!world) {
    if (!ros::param::get("~world", path)) {
      throw angen::Error(std::string("no world: give one as argument or in ~world\n") + kUsage);
    }
    world = read(path);
  } else if (!ros::master::check()) {
    make(*world, 1);  // what is wrong with it is told before there is a master to wait for
  }
  angen::node::Settings settings;
  settings.fast = ros::param::param("~fast", false);
  settings.rate = number_param("~rate", settings.fast ? 0.0 : 1.0, 0.0);
  if (settings.fast && settings.rate > 0.0) {
    throw angen::Error("~fast goes as fast as it can, with ~rate 0 or none");
  }
  settings.clock_rate = number_param("~clock_rate", 100.0, 0.01);
  settings.models = folder_of(path) + "/models";
  settings.topics = angen::node::topics_named(ros::param::param<std::string>("~topics", "sensor"));
  const auto seed = static_cast<std::uint64_t>(number_param("~seed", 1.0, 0.0));
  const auto simulation = make(std::move(*world), seed);
  if (ros::param::param("~paused", false)) simulation->post(angen::sim::Pause{true});
  if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
  angen::node::Node node(*simulation, settings);
  ROS_INFO("%s; seed %lu", summary(path, *simulation).c_str(), static_cast<unsigned long>(seed));
  node.run(stop);
  ros::shutdown();
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  std::setlocale(LC_NUMERIC, "C");
  std::setlocale(LC_CTYPE, "C.UTF-8");  // log4cxx writes other letters as ? otherwise
  try {
    const std::vector<std::string> raw(argv + 1, argv + argc);
    if (!raw.empty() && (raw[0] == "--help" || raw[0] == "-h")) {
      std::fputs(kUsage, stdout);
      return EXIT_SUCCESS;
    }
    if (!raw.empty() && raw[0] == "--check") {
      if (raw.size() == 2) return check(raw[1]);
      std::fputs(kUsage, stderr);
      return 2;
    }
    std::string path;
    std::optional<angen::desc::World> world;
    for (const std::string& word : raw) {
      if (word.find(":=") != std::string::npos) continue;
      if (world) {
        std::fputs(kUsage, stderr);
        return 2;
      }
      path = word;
      world = read(path);
    }
    ros::init(argc, argv, "angen", ros::init_options::NoSigintHandler);
    end_on_signals();
    return run(path, std::move(world));
  } catch (const angen::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "angen_node: %s\n", problem.what());
  }
  return EXIT_FAILURE;
}
