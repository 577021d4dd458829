#include <gtest/gtest.h>

#include "core/diagnostics.h"
#include "robot.h"

namespace angen::physics::testing {
namespace {

/// A heightmap of `cells` by `cells`, of `size` m, all of it at height 0 but a corner.
Shape height_ground(std::uint32_t cells, double size) {
  auto grid = std::make_shared<HeightGrid>();
  *grid = {cells + 1, cells + 1, size, size, std::vector<float>((cells + 1) * (cells + 1), 0.0F)};
  grid->heights[0] = 3.0F;
  Shape shape;
  shape.type = Shape::Type::kHeightmap;
  shape.heights = grid;
  return shape;
}

desc::Model plane_model() { return static_shape("plane", plane_shape()); }

struct Rest {
  const char* name;
  Shape shape;
  double height;  // of its center when it rests
};

std::vector<Rest> solids() {
  return {{"box", box_shape({0.3, 0.3, 0.2}), 0.1},
          {"sphere", round_shape(Shape::Type::kSphere, 0.1), 0.1},
          {"cylinder", round_shape(Shape::Type::kCylinder, 0.15, 0.2), 0.1},
          {"mesh", mesh_box({0.3, 0.3, 0.2}), 0.1}};
}

void expect_rest(const desc::Model& ground, const Rest& solid) {
  SCOPED_TRACE(solid.name);
  TestWorld world;
  world.add(ground);
  desc::Model model = box_model("body", 3.0, {0.3, 0.3, 0.2}, {0.13, 0.21, solid.height + 0.02});
  model.links[0].collisions[0].shape = solid.shape;
  const LinkId link = world.only_link(world.add(model));
  world.run(3.0);
  EXPECT_NEAR(world.link(link).pose.position.z(), solid.height, 1.5e-3);
  EXPECT_FALSE(world.awake(link));
  EXPECT_NEAR(force_on(world, "body::link::collision").z(), 3.0 * 9.81, 0.3);
}

TEST(Shapes, RestOnABox) {
  for (const Rest& solid : solids()) expect_rest(floor_model(), solid);
}

TEST(Shapes, RestOnAPlane) {
  for (const Rest& solid : solids()) expect_rest(plane_model(), solid);
}

TEST(Shapes, RestOnAHeightmap) {
  for (const Rest& solid : solids()) {
    if (solid.shape.type == Shape::Type::kMesh) continue;
    expect_rest(static_shape("ground", mesh_floor(1.0, 3.0)), solid);
    expect_rest(static_shape("ground", height_ground(6, 6.0)), solid);
    expect_rest(static_shape("ground", height_ground(600, 6.0)), solid);  // across many tiles
  }
}

TEST(Shapes, AHeightmapMeetsAsTheMeshOfItsTriangles) {
  std::vector<double> z[2];
  for (int i = 0; i < 2; ++i) {
    auto grid = std::make_shared<HeightGrid>();
    *grid = {41, 41, 8.0, 8.0, {}};
    for (int k = 0; k < 41 * 41; ++k) {
      grid->heights.push_back(
          static_cast<float>(0.3 * std::sin(0.4 * (k % 41)) + 0.2 * std::cos(0.3 * (k / 41))));
    }
    Shape ground;
    if (i == 0) {
      ground.type = Shape::Type::kHeightmap;
      ground.heights = grid;
    } else {
      TriangleMesh mesh;
      for (std::uint32_t r = 0; r < 41; ++r) {
        for (std::uint32_t c = 0; c < 41; ++c) mesh.vertices.push_back(grid->vertex(c, r));
      }
      for (std::uint32_t r = 0; r < 40; ++r) {
        for (std::uint32_t c = 0; c < 40; ++c) {
          const std::uint32_t a = r * 41 + c;
          mesh.triangles.push_back({a, a + 41, a + 1});
          mesh.triangles.push_back({a + 1, a + 41, a + 42});
        }
      }
      ground = mesh_shape(mesh);
    }
    TestWorld world;
    world.add(static_shape("ground", ground));
    desc::Model ball = box_model("ball", 1, {0.1, 0.1, 0.1}, {0.3, -0.4, 0.8});
    ball.links[0].collisions[0].shape = round_shape(Shape::Type::kSphere, 0.1);
    const LinkId link = world.only_link(world.add(ball));
    for (int step = 0; step < 100; ++step) {
      world.run(0.01);
      z[i].push_back(world.link(link).pose.position.z());
    }
  }
  for (std::size_t i = 0; i < z[0].size(); ++i) ASSERT_NEAR(z[0][i], z[1][i], 1e-6) << i;
}

TEST(Shapes, AHeightmapThatIsTurnedAndMovedIsMetThere) {
  TestWorld world;
  desc::Model ground = static_shape("ground", height_ground(600, 6.0));
  ground.pose = {{30, -20, 5}, from_rpy(0.0, 0.1, 2.0)};
  world.add(ground);
  const LinkId box =
      world.only_link(world.add(box_model("box", 1, {0.2, 0.2, 0.2}, {30, -20, 5.2})));
  world.run(2.0);
  const Vec3 up = ground.pose.rotation * Vec3::UnitZ();
  EXPECT_NEAR((world.link(box).pose.position - ground.pose.position).dot(up), 0.1, 2e-3);
  EXPECT_FALSE(world.awake(box));
}

TEST(Shapes, RobotDrivesOnAMesh) {
  TestWorld world;
  world.add(static_shape("ground", mesh_floor(1.0, 3.0)));
  const ModelId robot = world.add(robot_model("robot", {0.05, 0.03, 0}));
  world.run(0.2);
  for (const JointId wheel : world.joints(robot)) world.set_motor(wheel, 0.3 / 0.035, 1.0);
  world.run(3.0);
  const Vec3 at = world.link(world.links(robot)[0]).pose.position;
  EXPECT_NEAR(at.x(), 0.95, 0.03);
  EXPECT_NEAR(at.z(), 0.0, 3e-3);
}

TEST(Shapes, PlaneIsPlacedAndTilted) {
  TestWorld world;
  const ModelId plane = world.add(plane_model());
  const LinkId box = world.only_link(world.add(box_model("box", 1, {0.2, 0.2, 0.2}, {0, 0, 0.1})));
  world.run(1.5);
  ASSERT_FALSE(world.awake(box));
  // 10 degrees hold by friction 1, and the box lies as the plane does.
  world.move(plane, {{0, 0, -0.2}, from_rpy(0.1745, 0, 0)});
  world.run(3.0);
  const Pose pose = world.link(box).pose;
  EXPECT_NEAR((pose.rotation * Vec3::UnitZ()).dot(Vec3::UnitZ()), std::cos(0.1745), 1e-3);
  EXPECT_FALSE(world.awake(box));
}

TEST(Shapes, APlaneThatCouldMoveIsRejected) {
  TestWorld world;
  desc::Model model = box_model("box", 1, {1, 1, 1});
  model.links[0].collisions[0].shape = plane_model().links[0].collisions[0].shape;
  EXPECT_THROW(world.add(model), Error);
}

TEST(Shapes, FarAwayAndHugeOnesTouchToo) {
  TestWorld world;
  world.add(static_box("ground", {3000, 3000, 1}, {0, 0, -0.5}));
  const LinkId near =
      world.only_link(world.add(box_model("near", 1, {0.2, 0.2, 0.2}, {0, 0, 0.1})));
  const LinkId far =
      world.only_link(world.add(box_model("far", 1, {0.2, 0.2, 0.2}, {-1400, 900, 0.1})));
  world.run(1.5);
  EXPECT_NEAR(world.link(near).pose.position.z(), 0.1, 1e-3);
  EXPECT_NEAR(world.link(far).pose.position.z(), 0.1, 1e-3);
  EXPECT_EQ(world.awake_count(), 0U);
}

TEST(Shapes, SoftOnesSinkByTheirWeightOverTheirStiffness) {
  desc::Physics settings;
  settings.contact_surface_layer = 0.0;
  TestWorld world(settings);
  desc::Model ground = floor_model();
  ground.links[0].collisions[0].stiffness = 2000.0;
  ground.links[0].collisions[0].damping = 100.0;
  world.add(ground);
  const LinkId ball = [&] {
    desc::Model model = box_model("ball", 2, {0.2, 0.2, 0.2}, {0, 0, 0.1});
    model.links[0].collisions[0].shape = round_shape(Shape::Type::kSphere, 0.1);
    return world.only_link(world.add(model));
  }();
  world.run(3.0);
  EXPECT_NEAR(0.1 - world.link(ball).pose.position.z(), 2.0 * 9.81 / 2000.0, 2e-4);
}

TEST(Joints, BallHoldsItsPoint) {
  TestWorld world;
  desc::Model model =
      model_of("m", {ghost_link("bob", 1, {0.1, 0.1, 0.1}, {{1, 0, 0}, Quat::Identity()})});
  model.joints = {joint_of(desc::Joint::Type::kBall, "world", "bob")};
  const ModelId id = world.add(model);
  world.add_force(world.joints(id)[0], 5.0);
  world.set_motor(world.joints(id)[0], 1.0, 5.0);
  for (int i = 0; i < 2000; ++i) {
    world.run(1e-3);
    const Pose pose = world.link(world.only_link(id)).pose;
    ASSERT_NEAR((pose * Vec3(-1, 0, 0)).norm(), 0.0, 1e-3);
  }
}

TEST(Joints, UniversalTurnsAboutBothAxesAndMeasuresTheFirst) {
  TestWorld world({}, Vec3::Zero());
  desc::Model model = model_of("m", {ghost_link("bob", 1, {0.2, 0.2, 0.2})});
  model.joints = {joint_of(desc::Joint::Type::kUniversal, "world", "bob")};
  desc::JointAxis axis;
  axis.xyz = Vec3::UnitX();
  axis.lower = -0.5;
  axis.upper = 0.5;
  model.joints[0].axes.push_back(axis);
  axis.xyz = Vec3::UnitY();
  model.joints[0].axes.push_back(axis);
  const ModelId id = world.add(model);
  const JointId joint = world.joints(id)[0];
  world.set_motor(joint, 0.4, 1.0);
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).velocity, 0.4, 1e-6);
  EXPECT_NEAR(world.joint(joint).position, 0.4, 1e-3);
  const Vec3 y = world.link(world.only_link(id)).pose.rotation * Vec3::UnitY();
  EXPECT_NEAR(std::atan2(y.z(), y.y()), 0.4, 1e-3);
  world.run(2.0);
  EXPECT_NEAR(world.joint(joint).position, 0.5, 2e-3);
}

}  // namespace
}  // namespace angen::physics::testing
