#include "physics/build.h"

#include <gtest/gtest.h>

#include "core/diagnostics.h"
#include "models.h"

namespace angen::physics::testing {
namespace {

TEST(Build, WithABadMassAreRejectedAndNothingIsAdded) {
  TestWorld world;
  desc::Model model = model_of("m", {box_link("a", 1.0, {1, 1, 1}), box_link("b", 0.0, {1, 1, 1})});
  model.links[1].source = {"m.sdf", 7};
  try {
    world.add(model);
    FAIL() << "a mass of 0 was taken";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("m.sdf:7: "), 0U) << error.what();
  }
  EXPECT_EQ(world.awake_count(), 0U);
  world.run(0.01);
}

TEST(Build, ThatAreKinematicStayWhereTheyArePlaced) {
  TestWorld world;
  desc::Model model = box_model("box", 1.0, {1, 1, 1}, {0, 0, 3});
  model.links[0].kinematic = true;
  const ModelId id = world.add(model);
  world.run(0.5);
  EXPECT_EQ(world.link(world.only_link(id)).pose.position.z(), 3.0);
  EXPECT_EQ(world.mass(world.only_link(id)), 0.0);
}

}  // namespace
}  // namespace angen::physics::testing
