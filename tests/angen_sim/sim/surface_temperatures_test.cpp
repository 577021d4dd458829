#include "sim/surface_temperatures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace angen::sim {
namespace {

struct Warmth : ::testing::Test {
  rays::Scene scene;
  SurfaceTemperatures surfaces{scene};
  rays::ShapeId plate = add();
  rays::ShapeId other = add();

  rays::ShapeId add() {
    Shape box;
    box.type = Shape::Type::kBox;
    box.size = Vec3(1.0, 1.0, 1.0);
    return scene.add(box, Pose{}, rays::Mobility::kStatic, Eigen::Vector3f::Ones());
  }
  Warming course(std::size_t number = 0) {
    scene.commit();
    return scene.warm_shapes().at(number).course;
  }
};

TEST_F(Warmth, GoesToItsLimitExponentially) {
  surfaces.set(plate, 300.0, 400.0, 20.0, 5 * kSecond, 1);
  for (const double t : {0.0, 1.0, 20.0, 100.0}) {
    surfaces.advance(5 * kSecond + from_seconds(t), 2);
    EXPECT_NEAR(course().at(5 * kSecond + from_seconds(t)), 400.0 - 100.0 * std::exp(-t / 20.0),
                1e-9);
    EXPECT_TRUE(surfaces.changed_since(1000));
  }
}

TEST_F(Warmth, ChangesElsewhereAreNone) {
  const Eigen::AlignedBox3d here(Vec3(-1.0, -1.0, -1.0), Vec3(1.0, 1.0, 1.0));
  const Eigen::AlignedBox3d elsewhere(Vec3(5.0, 5.0, 5.0), Vec3(6.0, 6.0, 6.0));
  surfaces.set(plate, 300.0, 310.0, 2.0, 0, 3);
  EXPECT_TRUE(surfaces.changed_since(1000, here));
  EXPECT_FALSE(surfaces.changed_since(0, elsewhere));
  surfaces.advance(60 * kSecond, 5);
  EXPECT_TRUE(surfaces.changed_since(5, here));
  EXPECT_FALSE(surfaces.changed_since(6, here));
  EXPECT_FALSE(surfaces.changed_since(0, elsewhere));
  surfaces.remove(plate);
  EXPECT_FALSE(surfaces.changed_since(0, here));  // its going is a change of the scene
}

TEST_F(Warmth, RestsAtItsLimitAndSaysWhenThatWas) {
  surfaces.set(plate, 300.0, 310.0, 2.0, 0, 1);
  surfaces.advance(18 * kSecond, 7);  // 1.2 mK left
  EXPECT_TRUE(surfaces.changed_since(1000));
  surfaces.advance(19 * kSecond, 8);  // 0.7 mK
  EXPECT_EQ(course(), Warming::constant(310.0));
  EXPECT_TRUE(surfaces.changed_since(8));
  EXPECT_FALSE(surfaces.changed_since(9));
}

TEST_F(Warmth, WithoutATimeConstantItIsThereAtOnce) {
  const std::uint64_t before = scene.revision();
  scene.commit();
  const std::uint64_t revision = scene.revision();
  EXPECT_GT(revision, before);
  surfaces.set(plate, 300.0, 350.0, 0.0, 0, 3);
  EXPECT_EQ(course(), Warming::constant(350.0));
  EXPECT_TRUE(surfaces.changed_since(3));
  EXPECT_FALSE(surfaces.changed_since(4));
  EXPECT_EQ(scene.revision(), revision);  // rays get the same answers
}

TEST_F(Warmth, WhatWasSetAgainOrRemovedChangesNoMore) {
  surfaces.set(plate, 300.0, 310.0, 100.0, 0, 1);
  surfaces.set(plate, 300.0, 290.0, 0.0, kSecond, 2);
  surfaces.advance(50 * kSecond, 3);
  EXPECT_EQ(course(), Warming::constant(290.0));
  surfaces.set(plate, 290.0, 310.0, 100.0, 0, 4);
  surfaces.remove(plate);
  scene.remove(plate);
  surfaces.advance(60 * kSecond, 5);
  scene.commit();
  EXPECT_TRUE(scene.warm_shapes().empty());
  EXPECT_FALSE(surfaces.changed_since(6));
}

}  // namespace
}  // namespace angen::sim
