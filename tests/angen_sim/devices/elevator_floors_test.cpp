#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "angen_sim/devices/elevators.h"

namespace angen::test {
namespace {

bool stands_at(const Rig& rig, std::int64_t floor) {
  return rig.mode() == "IDLE" && rig.state().get<std::int64_t>("floor") == floor;
}

TEST(ElevatorFloors, AreTheStoreysWithinItsTravel) {
  Catalog catalog;
  FakeWorld world;
  FakeJoint lift;
  lift.limits = {0.0, 6.5};
  lift.child = "cabin";
  world.joints.emplace_back("lift", lift);
  world.links.emplace_back("cabin", FakeLink());
  const auto stops = [&](const Parameters& parameters) {
    for (const auto& plugin : catalog.library("libros_plugin.so")) {
      if (plugin->kind().name != "elevator") continue;
      Params params(plugin_element(parameters));
      const std::unique_ptr<Device> elevator = plugin->make_device();
      elevator->configure(params, world);
      return elevator->stops();
    }
    return std::vector<double>();
  };
  using Heights = std::vector<double>;
  EXPECT_EQ(stops({}), (Heights{0.0, 6.5})) << "in a world without storeys";
  EXPECT_EQ(stops({{"floors", "3"}}), (Heights{0.0, 3.25, 6.5}));
  world.floor_heights = {0.0, 2.6, 6.1, 9.0};
  EXPECT_EQ(stops({}), (Heights{0.0, 2.6, 6.1}));
  EXPECT_EQ(stops({{"floors", "2"}}), (Heights{0.0, 2.6}));
  EXPECT_EQ(stops({{"floor_height", "3"}}), (Heights{0.0, 3.0}));
  world.joints[0].second.limits = {-1e16, 1e16};
  EXPECT_EQ(stops({}), world.floor_heights);
  world.floor_heights = {0.0};
  EXPECT_THROW(stops({}), Error);
}

TEST(ElevatorFloors, AreAtTheHeightsThatAreGiven) {
  Bench bench;
  Rig& rig = add_elevator(bench, 400.0, {{"stop", "0"}, {"stop", "1.5"}, {"stop", "4"}});
  ASSERT_GT(
      bench.run_until(
          4.0,
          [&] { return stands_at(rig, 0) && rig.state().get<std::string>("door_mode") == "OPEN"; }),
      0.0);
  const double heights[] = {0.0, 1.5, 4.0};
  for (const int floor : {1, 2, 0}) {
    bench.run(2.0);
    ASSERT_TRUE(rig.command("Floor" + std::to_string(floor)).accepted);
    EXPECT_GT(bench.run_until(15.0, [&] { return stands_at(rig, floor); }), 0.0);
    EXPECT_NEAR(rig.at("lift").position, heights[floor], 0.005);
  }
  EXPECT_NE(rig.command("Floor3").reason.find("Floor0 to Floor2"), std::string::npos);
}

TEST(ElevatorFloors, RiseFromZero) {
  for (const Parameters& stops : std::vector<Parameters>{{{"stop", "1"}, {"stop", "2"}},
                                                         {{"stop", "0"}, {"stop", "0"}},
                                                         {{"stop", "0"}, {"stop", "9"}}}) {
    Bench bench;
    EXPECT_THROW(add_elevator(bench, 400.0, stops), Error);
  }
}

}  // namespace
}  // namespace angen::test
