#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "angen_sim/sensors/bench.h"

namespace angen {
namespace {

using test::Bench;
using test::FakeWorld;
using test::plugin_element;

class Examples : public testing::Test {
 protected:
  void SetUp() override { setenv("ANGEN_PLUGIN_PATH", ANGEN_EXAMPLES_PATH, 1); }
};

TEST_F(Examples, TheTapeMeasureMeasures) {
  Bench bench("libtape_measure.so", plugin_element({{"reach", "5"}}));
  const Reading far = bench.sample();
  EXPECT_TRUE(std::isinf(far.get<double>("distance")));
  bench.add(test::box(1, 1, 1), test::at(3.0));
  const Reading near = bench.sample();
  EXPECT_NEAR(near.get<double>("distance"), 2.5, 1e-6);
}

TEST_F(Examples, TheTurntableTurnsOnCommand) {
  Catalog catalog;
  const auto plugin = catalog.library("libturntable.so").at(0);
  ModelInfo model;
  EXPECT_FALSE(plugin->serves(model));
  model.joints = {{"spindle", "revolute", "base", "plate"}};
  EXPECT_TRUE(plugin->serves(model));

  FakeWorld world;
  world.joints = {{"spindle", {}}};
  Params params(plugin_element({{"speed", "3"}}));
  const auto device = plugin->make_device();
  device->configure(params, world);
  params.finish();

  const auto command = [&](const std::string& text) {
    Command made{text, {}, "", 0.0};
    if (!parse_command(plugin->kind(), made).empty()) return false;
    const Verdict verdict = device->command(made, world);
    if (verdict.act) verdict.act();
    return verdict.accepted;
  };
  EXPECT_FALSE(command("Dance"));
  EXPECT_TRUE(command("Start"));
  device->update(world, world);
  EXPECT_EQ(world.joint_named("spindle").motor_velocity, 3.0);
  EXPECT_EQ(world.joint_named("spindle").motor_force, 2.0);
  Reading state;
  device->report(world, state);
  EXPECT_TRUE(state.get<bool>("running"));
  EXPECT_TRUE(command("Turn -1"));
  device->update(world, world);
  EXPECT_EQ(world.joint_named("spindle").motor_velocity, -1.0);
  ASSERT_EQ(world.events.size(), 2U);
  EXPECT_EQ(world.events[0].first, "started");
}

}  // namespace
}  // namespace angen
