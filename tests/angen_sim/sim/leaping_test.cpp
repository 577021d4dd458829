// A run that leaps over what does not happen, against one that takes every tick.
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "angen_sim/sim/room.h"
#include "core/random.h"

namespace angen::sim {
namespace {

const std::string kDoor = R"(<model name='hall_door'><pose>-2 2 0 0 0 0</pose>
  <link name='base'><pose>0 0 1 0 0 0</pose><inertial><mass>5</mass></inertial></link>
  <link name='leaf'><pose>0.4 0 1 0 0 0</pose><inertial><mass>20</mass><inertia><ixx>7</ixx>
    <iyy>8</iyy><izz>1.1</izz></inertia></inertial><collision name='c'><geometry><box>
    <size>0.8 0.04 1.9</size></box></geometry></collision></link>
  <joint name='fix' type='fixed'><parent>world</parent><child>base</child></joint>
  <joint name='hinge' type='revolute'><parent>base</parent><child>leaf</child>
    <pose>-0.4 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower>
    <upper>0.001</upper></limit></axis></joint>
  <plugin name='d' filename='libdoor_world_plugin.so'/></model>)";

const std::string kLamp = R"(<model name='hall_lamp'><static>true</static><pose>0 0 2.5 0 0 0</pose>
  <link name='link'><light name='l' type='point'><diffuse>1 1 1 1</diffuse></light></link>
  <plugin name='l' filename='libros_plugin.so'/></model>)";

const std::string kPerson = R"(<actor name='person'><script><loop>true</loop><trajectory id='0'
  type='walk'><waypoint><time>0</time><pose>-1.5 -2 0 0 0 0</pose></waypoint>
  <waypoint><time>7</time><pose>-1.5 -2 0 0 0 1</pose></waypoint>
  <waypoint><time>9</time><pose>0.5 -2 0 0 0 0</pose></waypoint>
  <waypoint><time>20</time><pose>0.5 -2 0 0 0 0</pose></waypoint>
  <waypoint><time>22</time><pose>-1.5 -2 0 0 0 0</pose></waypoint></trajectory></script></actor>)";

std::string text_of_world() {
  std::string text = room();
  const std::string lux =
      "<sensor name='lux' type='camera'><update_rate>1</update_rate><camera><image><width>1</width>"
      "<height>1</height></image></camera><plugin name='l' filename="
      "'libluminosity_sensor_controller.so'><noise_stddev>0.01</noise_stddev></plugin></sensor>";
  const std::string bumper =
      "<sensor name='bump' type='contact'><update_rate>5</update_rate><contact><collision>c"
      "</collision></contact><plugin name='b' filename='libgazebo_ros_bumper.so'/></sensor>";
  const std::string more =
      kDoor + kLamp + kPerson +
      body("lux", "<box><size>0.05 0.05 0.05</size></box>", "1 1 2 0 1.57 0", true, lux) +
      body("pad", "<box><size>0.5 0.5 0.1</size></box>", "-1 -0.5 0.3 0 0 0", false, bumper);
  const std::string end = "</world></sdf>";
  return text.replace(text.find(end), end.size(), more + end);
}

std::string custom(const std::string& name, const std::string& library, const std::string& more) {
  return "<sensor name='" + name + "' type='custom'><update_rate>1</update_rate><plugin name='p' " +
         "filename='lib" + library + ".so'>" + more + "</plugin></sensor>";
}

/// What changes by itself, and sensors of what devices tell.
std::string text_of_household() {
  const std::string none = "<box><size>0.05 0.05 0.05</size></box>";
  const std::string mat =
      "<sensor name='mat' type='contact'><contact><collision>c</collision></contact>"
      "<plugin name='m' filename='libpressure_mat.so'><threshold>0.5</threshold></plugin></sensor>";
  const std::string sensors =
      custom("t", "temperature_sensor", "") + custom("h", "humidity_sensor", "") +
      custom("noisy", "temperature_sensor", "<noise_stddev>0.2</noise_stddev>") +
      custom("tags", "rfid_reader", "<beam_angle>6.2</beam_angle>") +
      custom("meter", "smart_plug", "<load>heater/stove</load>") +
      custom("other", "smart_plug", "<load>lamp/hall0</load><noise_stddev>0.1</noise_stddev>") +
      ray_sensor("near", "libgazebo_ros_range.so", 10, 0.01);
  std::string door = kDoor;
  const std::string base = "</mass></inertial></link>";
  door.insert(door.find(base) + base.size() - 7,
              "<sensor name='reed' type='custom'><pose>0.8 0 0.01 0 0 0</pose><plugin name='r' "
              "filename='libreed_contact.so'><magnet_link>leaf</magnet_link>"
              "<magnet>0.4 0 0</magnet></plugin></sensor>");
  return "<sdf version='1.6'><world name='w'>" + door + kLamp + kPerson +
         "<model name='flat'><static>true</static><link name='l'/><plugin name='c' "
         "filename='libroom_climate.so'><room>-3 -3 0 3 2 2.5</room><room>-3 2 0 3 4 2.5</room>"
         "</plugin></model><model name='stove'><static>true</static><link name='l'/>"
         "<plugin name='h' filename='libheater.so'/><plugin name='t' filename='librfid_tag.so'/>"
         "<plugin name='b' filename='librobot_battery.so'/></model>" +
         body("it", none, "-0.5 -2 0.8 0 0 0", true, sensors) +
         body("floor", "<box><size>9 9 0.2</size></box>", "0 0 -0.1 0 0 0", true, mat) +
         body("brick", "<box><size>0.4 0.2 0.6</size></box>", "1 0 1.2 0 0 0", false) +
         "</world></sdf>";
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
    for (auto* simulation : {&walks, &leaps}) {
      *simulation = std::make_unique<Simulation>(load::world_from_text(text, "test", {}), 5,
                                                 std::make_shared<Catalog>());
    }
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
                 ray_sensor("calm", kPir, 10, 0.0) + ray_sensor("noisy", kPir, 10, 0.01) +
                     ray_sensor("nods", kPir, 10, 0.01, kNodding)) +
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
  race.run(5.0);  // the person comes to a stand
  race.landings = 0;
  race.run(60.0);
  EXPECT_LT(race.landings, 600U);
  const auto last = race.leaps->snapshot();
  const auto of = [&](const char* name) -> const Reading& {
    std::size_t i = 0;
    while (last->structure->sensors[i].name != name) ++i;
    return *last->sensors[i];
  };
  EXPECT_NEAR(of("it_meter").get<double>("energy"), 10500.0, 10.0);
  EXPECT_GT(of("it_t").get<double>("temperature"), 19.0);
  EXPECT_LT(of("it_t").get<double>("temperature"), 21.0);
  EXPECT_TRUE(of("floor").get<bool>("pressed"));
  EXPECT_FALSE(of("hall_door").get<bool>("closed"));
}

TEST(Leaping, AStepIsAnsweredAtItsEnd) {
  Race race("<sdf version='1.6'><world name='w'/></sdf>");
  race.leaps->post(Pause{true});
  race.leaps->tick();
  std::future<Outcome> done = race.leaps->post(Step{5000});
  EXPECT_EQ(race.leaps->leap(60 * kSecond)->tick, 5000);
  EXPECT_EQ(done.wait_for(std::chrono::seconds(0)), std::future_status::ready);
}

}  // namespace
}  // namespace angen::sim
