#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "angen_sim/sim/household.h"
#include "record/log.h"
#include "record/recorder.h"
#include "record/replay.h"

/// Runs that are recorded, and their logs.
namespace angen::record {

inline std::string read_all(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline void write_all(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A folder of the test's own, with a world in it.
struct Folder {
  explicit Folder(const std::string& sdf = sim::text_of_household()) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path = std::filesystem::path(testing::TempDir()) /
           (std::string("angen_") + info->test_suite_name() + "_" + info->name());
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
    write_all(world(), sdf);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string world() const { return (path / "home.world").string(); }
  std::string log() const { return (path / "run.log").string(); }

  std::filesystem::path path;
};

/// A simulation of the folder's world that is recorded, by leaps.
class Session {
 public:
  explicit Session(const Folder& folder, std::uint64_t seed = 3)
      : simulation(load::world(folder.world()), seed, std::make_shared<Catalog>()),
        recorder(std::make_unique<Recorder>(folder.log(), origin_of(folder.world()), simulation)) {}

  sim::Simulation& operator*() { return simulation; }

  void tick() { recorder->add(*simulation.tick()); }
  void run(double seconds) {
    const Nanoseconds end = simulation.snapshot()->time + from_seconds(seconds);
    while (simulation.snapshot()->time < end) {
      const auto here = simulation.snapshot();
      recorder->add(*simulation.leap(std::min(end, recorder->leap_limit(*here))));
    }
  }
  void command(const std::string& kind, const std::string& name, const std::string& text) {
    simulation.post(sim::ToDevice{kind, name, {text, {}}});
  }
  void end() { recorder.reset(); }

  sim::Simulation simulation;
  std::unique_ptr<Recorder> recorder;
};

inline Replay replayed(const std::string& path, ReplaySettings settings = {}) {
  Replay replay(read_log(path), std::make_shared<Catalog>(), settings);
  while (!replay.done()) replay.advance();
  return replay;
}

inline sim::Spawn crate(const std::string& name, double x, double height) {
  const std::string text = sim::body("crate", "<box><size>0.3 0.3 0.3</size></box>", "0 0 0 0 0 0",
                                     false, sim::ray_sensor("eye", sim::kPir, 10, 0.01));
  Pose pose{{x, 0.123456789012345, height}, from_rpy(0.1, 0.2, 1.0 / 3.0)};
  return {load::model(text, name, pose, {})};
}

}  // namespace angen::record
