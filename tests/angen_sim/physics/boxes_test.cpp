#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/random.h"
#include "physics/touching.h"

namespace angen::physics::testing {
namespace {

struct Boxes {
  Boxes() { ode::prepare_thread(); }
  std::size_t collide() {
    return collide_boxes(lower.get(), upper.get(), points.data(), points.size());
  }
  ode::GeomHandle lower{dCreateBox(nullptr, 0.42, 0.42, 0.04)};
  ode::GeomHandle upper{dCreateBox(nullptr, 0.56, 0.36, 0.15)};
  std::array<dContactGeom, 16> points{};
};

TEST(Boxes, AllButParallelAreFoundAtTheirDepth) {
  Boxes boxes;
  Rng rng(1, hash_bytes("boxes"), 0);
  for (int i = 0; i < 20'000; ++i) {
    const double yaw = 6.0 * rng.uniform();
    const Quat upright = from_rpy(0.0, 0.0, yaw);
    Quat leant = upright;
    leant.coeffs()[i % 4] += std::pow(10.0, -20.0 + 13.0 * rng.uniform());
    const double depth = 1e-6 + 0.01 * rng.uniform();
    ode::set_pose(boxes.lower.get(), {{0, 0, -0.02}, leant});
    ode::set_pose(boxes.upper.get(),
                  {{0.15 * std::cos(yaw), 0.15 * std::sin(yaw), 0.075 - depth}, upright});
    ASSERT_EQ(boxes.collide(), 4U) << i;
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(boxes.points[k].depth, depth, 1e-7);
      EXPECT_NEAR(boxes.points[k].normal[2], -1.0, 1e-9);
      EXPECT_NEAR(boxes.points[k].pos[2], 0.0, depth + 1e-7);
    }
  }
}

// Poses that a chair's seat and a sitter's thighs had, at which dBoxBox() of ODE 0.16 finds
// nothing.
TEST(Boxes, AreFoundWhereOdeOverlooksThem) {
  Boxes boxes;
  const dMatrix3 seat{0x1.14a280fb5068ap-1,  -0x1.aed548f090ceep-1, -0x1.00acb59bafed7p-27, 0,
                      0x1.aed548f090ceep-1,  0x1.14a280fb5068cp-1,  -0x1.8fbf4068debc8p-27, 0,
                      0x1.db0eb64fa3ef5p-27, -0x1.02e14p-61,        0x1.fffffffffffffp-1,   0};
  const dMatrix3 thighs{0x1.14a280fb5068cp-1,
                        -0x1.aed548f090ceep-1,
                        0,
                        0,
                        0x1.aed548f090ceep-1,
                        0x1.14a280fb5068cp-1,
                        0,
                        0,
                        0,
                        0,
                        1,
                        0};
  dGeomSetRotation(boxes.lower.get(), seat);
  dGeomSetPosition(boxes.lower.get(), -3.4e-9, -5.2e-9, 0.45);
  dGeomSetRotation(boxes.upper.get(), thighs);
  dGeomSetPosition(boxes.upper.get(), 0.081, 0.1262, 0.5375);
  EXPECT_EQ(boxes.collide(), 4U);
}

TEST(Boxes, AgreeWithOdeWhereNothingIsParallel) {
  Boxes boxes;
  Rng rng(2, hash_bytes("boxes"), 0);
  int touching = 0;
  for (int i = 0; i < 5'000; ++i) {
    const auto pose = [&] {
      const auto random = [&] { return 0.6 * (rng.uniform() - 0.5); };
      const Vec3 at(random(), random(), random());
      return Pose{at, from_rpy(10.0 * random(), 5.0 * random(), 10.0 * random())};
    };
    ode::set_pose(boxes.lower.get(), pose());
    ode::set_pose(boxes.upper.get(), pose());
    std::array<dContactGeom, 16> expected{};
    const int n = dCollide(boxes.lower.get(), boxes.upper.get(), 16, expected.data(),
                           static_cast<int>(sizeof(dContactGeom)));
    ASSERT_EQ(boxes.collide(), static_cast<std::size_t>(n)) << i;
    for (int k = 0; k < n; ++k) {
      EXPECT_LT((ode::vec(boxes.points[k].pos) - ode::vec(expected[k].pos)).norm(), 1e-9) << i;
      EXPECT_LT((ode::vec(boxes.points[k].normal) - ode::vec(expected[k].normal)).norm(), 1e-9)
          << i;
      EXPECT_NEAR(boxes.points[k].depth, expected[k].depth, 1e-9) << i;
    }
    touching += n > 0 ? 1 : 0;
  }
  EXPECT_GT(touching, 1000);
}

}  // namespace
}  // namespace angen::physics::testing
