#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models.h"
#include "physics/touching.h"

namespace angen::physics::testing {
namespace {

/// A cylinder along z: `sides` corners at each end, which are fans.
Shape mesh_cylinder(double radius, double length, std::uint32_t sides) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * i / sides;
    for (const double z : {-length / 2.0, length / 2.0}) {
      mesh.vertices.push_back(
          Vec3(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>());
    }
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
    if (i == 0) continue;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a + 1, b + 1});
  }
  return mesh_shape(std::move(mesh));
}

desc::Model turned_plane(const Quat& turned) {
  desc::Model model = static_shape("plane", plane_shape());
  model.pose.rotation = turned;
  return model;
}

desc::Model drum(const Pose& pose) {
  desc::Link link = box_link("link", 2.0, {0.2, 0.2, 0.1});
  link.collisions = {collision(mesh_cylinder(0.1, 0.1, 720))};
  return model_of("drum", {link}, pose);
}

// Half of 1440 corners are below the plane, on a floor that is level or tilted.
TEST(MeshPlane, TheDeepestAndTheOutermostCornersAreFound) {
  for (const double tilt : {0.0, 0.3, -1.0}) {
    const Quat turned = from_rpy(tilt, 0.0, 0.0);
    TestWorld world({}, Vec3::Zero());
    world.add(turned_plane(turned));
    world.add(drum({Vec3::Zero(), turned * from_rpy(M_PI / 2.0, 0.0, 0.0)}));
    world.run(1e-3);
    const std::vector<ContactPair> pairs = world.contacts();
    ASSERT_EQ(pairs.size(), 1U) << tilt;
    const std::vector<ContactPoint>& points = pairs[0].points;
    double deepest = 0.0;
    Eigen::AlignedBox3d box;
    for (const ContactPoint& point : points) {
      EXPECT_NEAR((point.normal - turned * -Vec3::UnitZ()).norm(), 0.0, 1e-12);
      deepest = std::max(deepest, point.depth);
      box.extend(turned.inverse() * point.position);
    }
    EXPECT_NEAR(deepest, 0.1, 1e-5) << tilt;
    EXPECT_NEAR(box.sizes().x(), 0.2, 5e-3) << tilt;
    EXPECT_NEAR(box.sizes().y(), 0.1, 1e-5) << tilt;
  }
}

TEST(MeshPlane, AWheelRollsDownAsACylinderDoes) {
  const double slope = 0.1;
  TestWorld world;
  world.add(turned_plane(from_rpy(slope, 0.0, 0.0)));
  const Quat lying = from_rpy(slope, 0.0, 0.0) * from_rpy(0.0, M_PI / 2.0, 0.0);
  const LinkId link =
      world.only_link(world.add(drum({from_rpy(slope, 0, 0) * Vec3(0, 0, 0.1), lying})));
  world.run(1.0);
  // From rest, as if the mass were greater by I / r^2; each corner is a small impact.
  const double inertia = 2.0 / 12.0 * (0.2 * 0.2 + 0.2 * 0.2);
  const double acceleration = 9.81 * std::sin(slope) / (1.0 + inertia / (2.0 * 0.1 * 0.1));
  EXPECT_NEAR(world.link(link).linear_velocity.norm(), acceleration, 0.05 * acceleration);
}

}  // namespace
}  // namespace angen::physics::testing
