#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "core/files.h"
#include "core/text.h"
#include "node/freed_memory.h"
#include "node/node.h"
#include "node/other_node.h"
#include "node/text.h"
#include "plugin/library.h"
#include "record/recorder.h"
#include "record/replay.h"
#include "record/world_file.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace {

using angen::sim::Simulation;

constexpr char kUsage[] =
    "usage: angen_node [WORLD] [_rate:=1] [_paused:=false] [_seed:=1] [_clock_rate:=100]\n"
    "                  [_fast:=false] [_topics:=sensor|kind] [_record:=FILE]\n"
    "                  [_replay:=FILE [_until:=SECONDS]] [_allow_paths:=false] [_rescue:=FILE]\n"
    "                  [_memory_limit:=4096] [_states_rate:=30] [_strict:=true|false]\n"
    "                  [_odom_parent:=world|none] [_commands:='TARGET TEXT; ...']\n"
    "                  [_replace:=true]\n"
    "       angen_node --check WORLD    only loads; exit code 1 when it cannot\n"
    "WORLD may also be the parameter ~world. Where the ROS master was restarted, the node\n"
    "saves the world in FILE and ends with exit code 75.\n";

constexpr std::uint64_t kDefaultSeed = 1;
constexpr double kGreatestSeed = 9007199254740992.0;  // 2^53: up to here a double has each number
constexpr std::chrono::milliseconds kMasterPeriod{50};
constexpr double kLongestTime = 9e9;  // s, so that it fits into nanoseconds

std::atomic<bool> stop{false};

void on_signal(int) { stop = true; }

void end_on_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// Returns when the ROS master answers, or false after a signal: calls of roscpp to one that does
/// not answer retry forever and ignore signals. With parameters such as _seed:=2, ros::init() waits
/// for the master already, and a signal ends the process.
bool wait_for_master() {
  bool printed = false;
  while (!ros::master::check()) {
    if (stop) return false;
    if (!std::exchange(printed, true)) {
      std::fprintf(stderr, "angen_node: waiting for the ROS master at %s\n",
                   ros::master::getURI().c_str());
    }
    std::this_thread::sleep_for(kMasterPeriod);
  }
  return true;
}

/// Throws Error if it does not load; prints warnings on stderr.
angen::desc::World read(const std::string& path) {
  if (path.empty()) throw angen::Error("'': not a path; give the file of a world");
  angen::desc::World world = angen::load::world(path);
  for (const angen::Diagnostic& warning : world.warnings) {
    std::fprintf(stderr, "%s\n", warning.text().c_str());
  }
  return world;
}

/// Throws Error if it does not load; prints the number of ignored elements on stderr.
std::unique_ptr<Simulation> make(const std::string& path, std::uint64_t seed) {
  angen::desc::World world = read(path);
  const std::size_t ignored = world.ignored.size();
  auto simulation =
      std::make_unique<Simulation>(std::move(world), seed, std::make_shared<angen::Catalog>());
  for (const angen::sim::Event& event :
       simulation->snapshot()->events) {  // events of its construction
    if (event.event == "warning") std::fprintf(stderr, "%s\n", event.detail.c_str());
  }
  if (ignored > 0) {
    std::fprintf(stderr, "%zu %s ignored, angen check lists %s\n", ignored,
                 ignored == 1 ? "element is" : "elements are", ignored == 1 ? "it" : "them");
  }
  return simulation;
}

std::string summary(const std::string& path, const Simulation& simulation) {
  const angen::sim::Structure& structure = *simulation.snapshot()->structure;
  return path + ": " + std::to_string(structure.models.size()) + " models, " +
         std::to_string(structure.devices.size()) + " devices, " +
         std::to_string(structure.sensors.size()) + " sensors";
}

int check(const std::string& path) {
  std::printf("%s\n", summary(path, *make(path, kDefaultSeed)).c_str());
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

void check_rate(double rate, angen::Nanoseconds step) {
  const std::string problem = angen::node::rate_problem(rate, step);
  if (!problem.empty()) throw angen::Error("~rate is " + angen::number_text(rate) + "; " + problem);
}

/// The parameter, which may be left out; throws Error for one of another type.
template <class Value>
Value param_or(const std::string& name, Value fallback) {
  if (ros::param::has(name) && !ros::param::get(name, fallback)) {
    throw angen::Error(name + " must be " +
                       (std::is_same_v<Value, bool> ? "true or false" : "a text"));
  }
  return fallback;
}

/// The value of a private parameter on the command line, as _seed:=2; none without it. ROS is not
/// needed.
std::optional<std::string> given(const std::vector<std::string>& words, const std::string& name) {
  const std::string begin = "_" + name + ":=";
  for (const std::string& word : words) {
    if (word.rfind(begin, 0) == 0) return word.substr(begin.size());
  }
  return std::nullopt;
}

std::optional<double> given_number(const std::vector<std::string>& words, const std::string& name) {
  const std::optional<std::string> text = given(words, name);
  return text ? angen::parse_finite(*text) : std::nullopt;
}

/// ~until, a time in s; a launch file gives an empty text for none.
std::optional<angen::Nanoseconds> until_param() {
  std::string text;
  double seconds = 0.0;
  if (ros::param::get("~until", text)) {
    if (text.empty()) return std::nullopt;
    seconds = angen::parse_finite(text).value_or(-1.0);
  } else if (ros::param::has("~until")) {
    seconds = number_param("~until", 0.0, 0.0);
  } else {
    return std::nullopt;
  }
  if (seconds < 0.0 || seconds > kLongestTime) {
    throw angen::Error("~until must be a time in s, such as 12.5");
  }
  return angen::from_seconds(seconds);
}

/// The replay of ~replay, up to ~until; null without the parameter.
std::unique_ptr<angen::record::Replay> make_replay(angen::node::Settings& settings) {
  const auto path = param_or<std::string>("~replay", "");
  const std::optional<angen::Nanoseconds> until = until_param();
  if (path.empty()) {
    if (until) throw angen::Error("~until ends a replay; give its file as ~replay");
    return nullptr;
  }
  settings.hurry = until.has_value();
  auto replay = std::make_unique<angen::record::Replay>(
      angen::record::read_log(path), std::make_shared<angen::Catalog>(),
      angen::record::ReplaySettings{settings.fast || settings.hurry, false});
  if (until) replay->stop_at(*until);
  return replay;
}

/// Null if ~record names nothing.
std::unique_ptr<angen::record::Recorder> make_recorder(const std::string& world,
                                                       const angen::node::Settings& settings,
                                                       Simulation& simulation) {
  const auto file = param_or<std::string>("~record", "");
  if (file.empty()) return nullptr;
  if (settings.replay == nullptr) {
    return std::make_unique<angen::record::Recorder>(file, angen::record::origin_of(world),
                                                     simulation);
  }
  const angen::record::LogHeader& header = settings.replay->log().header;
  return std::make_unique<angen::record::Recorder>(
      file, angen::record::Origin{header.world, header.sdf, settings.models}, simulation);
}

// Everything that is loaded from now on may name files and libraries anywhere.
void allow_all_paths() { setenv("ANGEN_ALLOW_PATHS", "true", 1); }

// Unknown elements of worlds and models are errors, or warnings.
void set_strict(const std::string& word) {
  if (word.empty()) return;
  if (word != "true" && word != "false") {
    throw angen::Error("~strict is '" + word + "', must be true or false");
  }
  setenv("ANGEN_STRICT", word.c_str(), 1);
}

// A launch file gives true or false, or an empty text for neither.
void set_strict_by_param() {
  bool flag = false;
  if (ros::param::get("~strict", flag)) {
    set_strict(flag ? "true" : "false");
  } else {
    set_strict(param_or<std::string>("~strict", ""));
  }
}

/// ~commands are executed before the first tick, so that runs with the same ones are equal.
void post_commands(Simulation& simulation, bool replays) {
  std::vector<angen::sim::Action> actions =
      angen::node::listed_actions(param_or<std::string>("~commands", ""));
  if (replays && !actions.empty()) {
    throw angen::Error("~commands begin a run; a replay has those of its log");
  }
  for (angen::sim::Action& action : actions) simulation.post(std::move(action));
}

/// Exit code (EX_TEMPFAIL of sysexits.h) of a node that ends because the ROS master was started
/// again: its world is saved, and a new node may continue it.
constexpr int kRescued = 75;

/// rescue.world in state_folder(), rescue_house1.world for a node in the namespace /house1.
std::string default_rescue_path() {
  std::string space = ros::this_node::getNamespace();
  std::replace(space.begin(), space.end(), '/', '_');
  return angen::state_folder() + "/rescue" + (space == "_" ? "" : space) + ".world";
}

/// Writes the world as it is now, all of it or nothing, for this user alone.
void rescue(Simulation& simulation, const std::string& path) {
  const std::string text = angen::record::world_file(simulation.world(), simulation.saved());
  try {
    if (path == default_rescue_path()) angen::make_private_folder(angen::state_folder());
    angen::write_private_file(path, text);
  } catch (const angen::Error& error) {
    throw angen::Error(std::string("the world cannot be saved in ") + error.what());
  }
}

int save_and_end(Simulation& simulation, const std::string& path) {
  rescue(simulation, path);
  std::fprintf(stderr,
               "angen_node: the ROS master at %s was restarted and does not know this node; the "
               "world as of %.3f s is saved in %s: start a node with it\n",
               ros::master::getURI().c_str(), angen::to_seconds(simulation.snapshot()->time),
               path.c_str());
  ros::shutdown();
  return kRescued;
}

int run(std::string path, std::unique_ptr<Simulation> simulation) {
  if (param_or("~allow_paths", false)) allow_all_paths();
  set_strict_by_param();
  const bool replays = !param_or<std::string>("~replay", "").empty();
  if (!simulation && !replays && !ros::param::get("~world", path)) {
    throw angen::Error(std::string("no world: give one as argument or in ~world\n") + kUsage);
  }
  angen::load::set_memory_limit(number_param("~memory_limit", angen::load::memory_limit(), 1.0));
  angen::node::Settings settings;
  settings.fast = param_or("~fast", false);
  settings.rate = number_param("~rate", settings.fast ? 0.0 : 1.0, 0.0);
  if (settings.fast && settings.rate > 0.0) {
    throw angen::Error("~fast runs without a rate: leave ~rate out, or give 0");
  }
  settings.clock_rate =
      number_param("~clock_rate", number_param("~pub_clock_frequency", 100.0, 0.01), 0.01);
  settings.states_rate = number_param("~states_rate", 30.0, 0.01);
  settings.plugins = angen::Catalog().own();
  const std::unique_ptr<angen::record::Replay> replay = make_replay(settings);
  if (replay) path = replay->log().header.world;
  const auto odom_parent = param_or<std::string>("~odom_parent", "world");
  if (odom_parent != "world" && odom_parent != "none") {
    throw angen::Error("~odom_parent is '" + odom_parent + "', must be world or none");
  }
  settings.odometry_in_world = odom_parent == "world";
  settings.replay = replay.get();
  settings.models = replay ? replay->models() : angen::load::models_beside(path);
  settings.topics = angen::node::topics_named(param_or<std::string>("~topics", "sensor"));
  const auto rescue_path = param_or<std::string>("~rescue", default_rescue_path());
  const double seed_given = number_param("~seed", kDefaultSeed, 0.0);
  if (seed_given > kGreatestSeed || seed_given != std::floor(seed_given)) {
    throw angen::Error("~seed is " + angen::number_text(seed_given) +
                       ", must be a whole number of at most 2^53");
  }
  const auto seed = static_cast<std::uint64_t>(seed_given);
  const bool usable = simulation && simulation->seed() == seed;
  if (!replay && !usable) simulation = make(path, seed);
  Simulation& running = replay ? replay->simulation() : *simulation;
  check_rate(settings.rate, running.snapshot()->step);
  const auto recorder = make_recorder(path, settings, running);
  settings.recorder = recorder.get();
  post_commands(running, replay != nullptr);
  settings.paused_after = param_or("~paused", false);
  if (settings.paused_after && !replay) running.post(angen::sim::Pause{true});
  if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
  angen::node::Node node(running, settings);
  ROS_INFO("%s; seed %lu", summary(path, running).c_str(),
           static_cast<unsigned long>(running.seed()));
  const angen::node::Node::End end = node.run(stop);
  if (end == angen::node::Node::End::kMasterLost) return save_and_end(running, rescue_path);
  ros::shutdown();
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  std::setlocale(LC_NUMERIC, "C");
  std::setlocale(LC_CTYPE, "C.UTF-8");  // log4cxx writes other letters as ? otherwise
  angen::node::use_one_heap();
  angen::node::keep_freed_memory(false);  // by itself malloc comes to keep 64 MB
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
    std::vector<std::string> paths;
    for (const std::string& word : raw) {
      if (word.find(":=") == std::string::npos) paths.push_back(word);
    }
    if (paths.size() > 1) {
      std::fputs(kUsage, stderr);
      return 2;
    }
    const std::string path = paths.empty() ? "" : paths[0];
    // Before ROS, which waits for a master: errors in the world need none.
    std::unique_ptr<Simulation> simulation;
    if (given(raw, "allow_paths") == "true") allow_all_paths();
    if (const auto limit = given_number(raw, "memory_limit")) angen::load::set_memory_limit(*limit);
    set_strict(given(raw, "strict").value_or(""));
    const double seed = std::max(0.0, given_number(raw, "seed").value_or(kDefaultSeed));
    if (!paths.empty()) simulation = make(path, static_cast<std::uint64_t>(seed));
    ros::init(argc, argv, "angen", ros::init_options::NoSigintHandler);
    end_on_signals();
    if (!wait_for_master()) return EXIT_SUCCESS;
    angen::node::require_no_other_node(given(raw, "replace") == "true");
    return run(path, std::move(simulation));
  } catch (const angen::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "angen_node: %s\n", problem.what());
  }
  return EXIT_FAILURE;
}
