// The maps that people share, of several storeys and worlds.
#include "people/storey_maps.h"

#include <gtest/gtest.h>

#include "angen_sim/fakes.h"

namespace angen::people {
namespace {

const FloorMap::Vec2 kGoal(2.0, 1.0);

TEST(StoreyMaps, AreThoseOfStaticShapesAsTheyAre) {
  rays::Scene scene;
  test::FakeWorld world;
  world.scene = &scene;
  StoreyMaps maps;
  const auto first = maps.find(world, Vec3::Zero(), kGoal);
  EXPECT_EQ(maps.find(world, Vec3::Zero(), kGoal), first);
  EXPECT_EQ(maps.find(world, {0.0, 0.0, 0.004}, kGoal), first);
  Shape wall;
  wall.type = Shape::Type::kBox;
  scene.add(wall, Pose{}, rays::Mobility::kStatic, Eigen::Vector3f::Zero());
  scene.commit();
  EXPECT_NE(maps.find(world, Vec3::Zero(), kGoal), first);
}

TEST(StoreyMaps, OfFourStoreysAreKept) {
  test::FakeWorld world;
  StoreyMaps maps;
  const auto ground = maps.find(world, Vec3::Zero(), kGoal);
  for (const double floor : {3.0, 6.0, 9.0}) maps.find(world, {0.0, 0.0, floor}, kGoal);
  EXPECT_EQ(maps.find(world, Vec3::Zero(), kGoal), ground);
  for (const double floor : {3.0, 6.0, 9.0, 12.0}) maps.find(world, {0.0, 0.0, floor}, kGoal);
  EXPECT_NE(maps.find(world, Vec3::Zero(), kGoal), ground);
}

}  // namespace
}  // namespace angen::people
