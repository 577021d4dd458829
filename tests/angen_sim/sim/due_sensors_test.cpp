// A run that leaps over ticks without events, against one that takes every tick.
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "angen_sim/sim/household.h"
#include "core/random.h"

namespace angen::sim {
namespace {

const std::string kModels = std::string(ANGEN_WORLDS_DIR) + "/models";

load::SearchPaths paths() {
  load::SearchPaths paths;
  paths.models = {kModels};
  return paths;
}

void expect_same_world(const Snapshot& a, const Snapshot& b) {
  ASSERT_EQ(a.tick, b.tick);
  for (std::size_t i = 0; i < a.link_poses.size(); ++i) {
    EXPECT_TRUE(a.link_poses[i] == b.link_poses[i]) << a.structure->links[i].name << a.time;
  }
  for (std::size_t i = 0; i < a.devices.size(); ++i) {
    ASSERT_EQ(a.devices[i] == nullptr, b.devices[i] == nullptr);
    if (a.devices[i] == nullptr) continue;
    EXPECT_TRUE(a.devices[i]->same_values(*b.devices[i])) << a.structure->devices[i].name << a.time;
    EXPECT_EQ(a.devices[i]->stamp, b.devices[i]->stamp) << a.structure->devices[i].name << a.time;
  }
  EXPECT_EQ(a.moved_links, b.moved_links) << a.time;
  EXPECT_EQ(a.new_states, b.new_states) << a.time;
  EXPECT_EQ(*a.light_levels, *b.light_levels) << a.time;
  EXPECT_EQ(a.counts.awake_bodies, b.counts.awake_bodies) << a.time;
}

struct Race {
  std::unique_ptr<Simulation> walks;
  std::unique_ptr<Simulation> leaps;
  std::size_t landings = 0;

  explicit Race(const std::string& text) {
    for (auto* simulation : {&walks, &leaps}) *simulation = simulation_of(text, 5);
  }
  void command(const std::string& kind, const std::string& name, const std::string& text) {
    walks->post(ToDevice{kind, name, {text, {}}});
    leaps->post(ToDevice{kind, name, {text, {}}});
  }
  void run(double seconds) {
    const Nanoseconds end = leaps->snapshot()->time + from_seconds(seconds);
    while (leaps->snapshot()->time < end && !::testing::Test::HasFailure()) {
      const auto landed = leaps->leap(end);
      ++landings;
      std::shared_ptr<const Snapshot> walked = walks->tick();
      while (walked->tick < landed->tick) {
        EXPECT_TRUE(walked->events.empty()) << walked->time << " " << walked->events[0].source;
        walked = walks->tick();
      }
      expect_same_world(*landed, *walked);
      expect_same_readings(*landed, *walked);
    }
    EXPECT_EQ(leaps->snapshot()->time, end);
  }
};

TEST(Leaping, EverySnapshotIsThatOfTakingAllTicks) {
  Race race(text_of_world());
  race.run(30.0);
  race.command("door", "hall0", "Open");
  race.run(8.0);
  race.command("lamp", "hall0", "On");
  race.run(1.0);
  race.command("person", "person", "Stop");
  race.run(15.0);
  race.command("person", "person", "Go");
  race.run(26.0);
  EXPECT_LT(race.landings, 60000U);
}

TEST(Leaping, AStillWorldTakesFewTicks) {
  Race race("<sdf version='1.6'><world name='w'>" + kDoor +
            body("it", "<box><size>0.1 0.1 0.1</size></box>", "0 0 1 0 0 0", true,
                 ray_sensor("clean", kPir, 10, 0.0) + ray_sensor("noisy", kPir, 10, 0.01) +
                     ray_sensor("nods", kPir, 10, 0.01, kNodding) +
                     ray_sensor("holds", kPir, 10, 0.01,
                                "<hold_time>1.25</hold_time><lockout_time>2.5</lockout_time>")) +
            "</world></sdf>");
  race.run(60.0);
  EXPECT_LT(race.landings, 6000U);
  race.landings = 0;
  race.run(600.0);
  EXPECT_LT(race.landings, 200U);
}

TEST(Leaping, WhatChangesByItselfIsNotLeaptOver) {
  Race race(text_of_household());
  race.run(12.0);
  race.command("heater", "stove", "On");
  race.run(10.5);
  race.command("heater", "stove", "Off");
  race.command("door", "hall0", "Open");
  race.run(20.0);
  race.command("lamp", "hall0", "On");
  race.run(1.0);
  race.command("lamp", "hall0", "Off");
  race.command("person", "person", "Stop");
  race.run(5.0);  // the person stops
  race.landings = 0;
  race.run(60.0);
  EXPECT_LT(race.landings, 600U);
  const auto last = race.leaps->snapshot();
  const auto of = [&](const char* name) {
    std::size_t i = 0;
    while (last->structure->sensors[i].name != name) ++i;
    return *last->reading(i);
  };
  EXPECT_NEAR(of("it_meter").get<double>("energy"), 10500.0, 10.0);
  EXPECT_GT(of("it_t").get<double>("temperature"), 19.0);
  EXPECT_LT(of("it_t").get<double>("temperature"), 21.0);
  EXPECT_TRUE(of("floor").get<bool>("pressed"));
  EXPECT_FALSE(of("hall_door").get<bool>("closed"));
}

TEST(Leaping, ASurfaceThatWarmsIsSeenAsAtEachTick) {
  const auto plate = [](const std::string& name, const std::string& pose) {
    const std::string box = "<geometry><box><size>0.02 0.4 0.4</size></box></geometry>";
    return "<model name='" + name + "'><static>true</static><pose>" + pose +
           "</pose><link name='l'><collision name='c'>" + box + "</collision><visual name='v'>" +
           box +
           "</visual></link><plugin name='w' filename='libwarm_surface.so'>"
           "<time_constant>3</time_constant></plugin></model>";
  };
  const std::string pir = "<model>pyroelectric</model><warm_up>0</warm_up>";
  Race race("<sdf version='1.6'><world name='w'>" +
            body("it", "<box><size>0.05 0.05 0.05</size></box>", "0 0 2.2 0 0 0", true,
                 ray_sensor("heat", kPir, 10, 0.0, pir) + ray_sensor("fan", kPir, 10, 0.01)) +
            plate("near", "2 0.2 1 0 0 0") + plate("aside", "3 -0.5 1 0 0 0") + "</world></sdf>");
  race.run(5.0);
  race.landings = 0;
  race.run(20.0);
  EXPECT_LT(race.landings, 300U);
  race.command("warm_surface", "near", "Temperature 400");
  race.run(2.5);
  const auto signal = [&] { return race.leaps->snapshot()->reading(0)->get<double>("signal"); };
  EXPECT_NE(signal(), 0.0);
  race.command("warm_surface", "aside", "Temperature 280");
  race.run(50.0);  // both are steady: 12 time constants, and the filter's rest
  EXPECT_EQ(signal(), 0.0);
  race.landings = 0;
  race.run(60.0);
  EXPECT_LT(race.landings, 700U);
  race.command("warm_surface", "near", "Air");
  race.run(1.0);
  EXPECT_NE(signal(), 0.0);
  race.run(40.0);
}

TEST(Leaping, ASignalThatDecaysIsLeaptOver) {
  const std::string pir =
      "<model>pyroelectric</model><warm_up>0</warm_up><hold_time>4</hold_time>"
      "<noise_stddev>3e-6</noise_stddev>";
  Race race(
      "<sdf version='1.6'><world name='w'>" +
      body("it", "<box><size>0.05 0.05 0.05</size></box>", "0 0 2.2 0 0 0", true,
           ray_sensor("heat", kPir, 10, 0.0, pir)) +
      "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry>"
      "<plane><normal>0 0 1</normal></plane></geometry></collision></link></model>"
      "<actor name='ann'><pose>3 -1 0 0 0 0</pose><plugin name='person' "
      "filename='libperson_controller.so'/></actor></world></sdf>");
  race.run(5.0);
  race.command("person", "ann", "GoTo 3 1");
  race.run(4.0);
  const auto reading = [&] { return race.leaps->snapshot()->reading(0); };
  EXPECT_TRUE(reading()->get<bool>("motion"));
  race.landings = 0;
  race.run(8.0);
  EXPECT_FALSE(reading()->get<bool>("motion"));
  EXPECT_NE(reading()->get<double>("signal"), 0.0);
  EXPECT_LT(race.landings, 300U);  // it samples 800 times
  race.run(20.0);
  EXPECT_EQ(reading()->get<double>("signal"), 0.0);
}

/// Shipped models with devices, except people, who walk.
std::vector<std::string> models_with_devices() {
  std::vector<std::string> uris;
  for (const auto& each : std::filesystem::directory_iterator(kModels)) {
    const std::string uri = "model://" + each.path().filename().string();
    if (!std::filesystem::exists(each.path() / "model.sdf") || uri == "model://sun") continue;
    const desc::Model model = load::model(uri, "it", {}, paths());
    const bool is_person =
        !model.plugins.empty() && model.plugins[0].filename == "libperson_controller.so";
    if (!model.plugins.empty() && !is_person) uris.push_back(uri);
  }
  return uris;
}

TEST(Leaping, DevicesAtRestAreNotUpdatedEachTick) {
  const std::vector<std::string> uris = models_with_devices();
  ASSERT_GT(uris.size(), 20U);
  for (const std::string& uri : uris) {
    const auto still =
        simulation_of(in_world("<include><uri>model://ground_plane</uri></include><include><uri>" +
                               uri + "</uri></include>"),
                      5, std::make_shared<Catalog>(), paths());
    while (still->snapshot()->time < 20 * kSecond) still->leap(20 * kSecond);
    int landings = 0;
    for (; still->snapshot()->time < 30 * kSecond; ++landings) still->leap(30 * kSecond);
    EXPECT_LT(landings, 100) << uri;
  }
}

TEST(Leaping, AStepIsAnsweredAtItsEnd) {
  Race race(in_world(""));
  race.leaps->post(Pause{true});
  race.leaps->tick();
  std::future<Outcome> done = race.leaps->post(Step{5000});
  EXPECT_EQ(race.leaps->leap(60 * kSecond)->tick, 5000);
  EXPECT_EQ(done.wait_for(std::chrono::seconds(0)), std::future_status::ready);
}

}  // namespace
}  // namespace angen::sim
