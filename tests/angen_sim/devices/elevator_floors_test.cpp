#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "angen_sim/devices/rig.h"

namespace angen::test {
namespace {

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

}  // namespace
}  // namespace angen::test
