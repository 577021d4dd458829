// Inside of solids: covered points, and parts of segments.
#include "rays/solid.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace angen::rays::testing {
namespace {

TEST(Solid, CoveredIsWithinAStandingSolidButNotTheOneLeftOut) {
  Scene scene;
  const ShapeId crate = add(scene, box(1, 1, 1));
  add(scene, round(Shape::Type::kSphere, 0.5), at(3, 0, 0));
  add(scene, round(Shape::Type::kCylinder, 0.5, 2.0), at(6, 0, 0));
  add(scene, round(Shape::Type::kCapsule, 0.5, 2.0), at(9, 0, 0));
  add(scene, box(1, 1, 1), at(12, 0, 0), Mobility::kMoving);
  scene.commit();
  const auto covered = [&](double x, double z) { return scene.covered(Vec3(x, 0, z), UINT32_MAX); };
  EXPECT_TRUE(covered(0.49, 0.49));
  EXPECT_TRUE(covered(0.5001, 0.0));  // a ray from there would start inside
  EXPECT_FALSE(covered(0.51, 0.0));
  EXPECT_FALSE(scene.covered(Vec3(0.2, 0, 0), crate.index));
  EXPECT_TRUE(covered(3.3, 0.3));
  EXPECT_FALSE(covered(3.4, 0.4));
  EXPECT_TRUE(covered(6.4, 0.9));
  EXPECT_FALSE(covered(6.4, 1.1));
  EXPECT_TRUE(covered(9.0, 1.4));
  EXPECT_FALSE(covered(9.4, 1.4));
  EXPECT_FALSE(covered(12.0, 0.0));
}

TEST(Solid, CrossingsAreTheInsidesOfWhatLiesOnASegment) {
  Scene scene;
  const ShapeId wall = add(scene, box(0.1, 4, 4), at(2, 0, 0));
  const ShapeId flush = add(scene, box(0.5, 1, 1), at(2.3, 0, 0), Mobility::kMoving);  // on it
  const ShapeId beam = add(scene, box(4, 1, 1), at(4, 0, 0));  // contains the next ones
  const ShapeId ball = add(scene, octahedron(0.5F), at(5, 0.1, 0.05));
  add(scene, box(1, 1, 1), at(9, 0, 0));   // beyond
  add(scene, box(1, 1, 1), at(-3, 0, 0));  // behind
  scene.commit();
  const std::vector<Crossing> found = scene.crossings(Vec3(0, 0, 0), Vec3(8, 0, 0));
  ASSERT_EQ(found.size(), 4U);
  const auto expect = [&](std::size_t i, ShapeId shape, double enter, double leave) {
    EXPECT_EQ(found[i].shape, shape.index) << i;
    EXPECT_NEAR(found[i].enter, enter, 1e-9) << i;
    EXPECT_NEAR(found[i].leave, leave, 1e-9) << i;
  };
  expect(0, wall, 1.95, 2.05);
  expect(1, beam, 2.0, 6.0);
  expect(2, flush, 2.05, 2.55);
  expect(3, ball, 4.65, 5.35);
  EXPECT_EQ(found[0].normal, Eigen::Vector3f(-1, 0, 0));
}

TEST(Solid, ACrossingEndsWhereItsSegmentDoes) {
  Scene scene;
  add(scene, box(2, 2, 2), at(0, 0, 0));
  add(scene, box(2, 2, 2), at(5, 0, 0));
  scene.commit();
  const std::vector<Crossing> found = scene.crossings(Vec3(0.5, 0, 0), Vec3(5, 0, 0));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].enter, 0.0);
  EXPECT_NEAR(found[0].leave, 0.5, 1e-12);
  EXPECT_NEAR(found[1].enter, 3.5, 1e-12);
  EXPECT_NEAR(found[1].leave, 4.5, 1e-12);
  EXPECT_TRUE(scene.crossings(Vec3(2, 0, 0), Vec3(3, 0, 0)).empty());
  EXPECT_TRUE(scene.crossings(Vec3(0, 0, 0), Vec3(0, 0, 0)).empty());
}

TEST(Solid, ALineThatTouchesAShapeIsNotInsideIt) {
  Scene scene;
  const ShapeId post = add(scene, round(Shape::Type::kCylinder, 0.5, 2.0), at(3, 0, 0));
  scene.commit();
  for (const double height : {0.0, 0.5}) {
    EXPECT_TRUE(scene.crossings(Vec3(0, 0.5, height), Vec3(8, 0.5, height)).empty()) << height;
  }
  const std::vector<Crossing> inside = scene.crossings(Vec3(3, 0.25, 0), Vec3(8, 0.25, 0));
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_EQ(inside[0].shape, post.index);
  EXPECT_EQ(inside[0].enter, 0.0);
}

}  // namespace
}  // namespace angen::rays::testing
