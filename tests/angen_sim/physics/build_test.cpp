#include "physics/build.h"

#include <gtest/gtest.h>

#include "models.h"

namespace angen::physics::testing {
namespace {

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
