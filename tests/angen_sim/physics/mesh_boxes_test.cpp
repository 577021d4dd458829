#include "physics/mesh_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <ctime>
#include <memory>
#include <random>

#include "angen_sim/physics/models.h"

namespace angen::physics::testing {
namespace {

/// Long triangles through the middle, each of which crosses most of another such mesh's.
TriangleMesh hedgehog(int spikes, unsigned seed) {
  std::mt19937 draw(seed);
  std::normal_distribution<float> gauss;
  TriangleMesh mesh;
  for (int i = 0; i < spikes; ++i) {
    const Eigen::Vector3f tip = Eigen::Vector3f(gauss(draw), gauss(draw), gauss(draw)).normalized();
    const Eigen::Vector3f aside = 0.02F * Eigen::Vector3f(gauss(draw), gauss(draw), gauss(draw));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {tip, aside - tip, -aside - tip});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Eigen::AlignedBox3f box_of(const TriangleMesh& mesh, std::size_t triangle) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t corner : mesh.triangles[triangle]) box.extend(mesh.vertices[corner]);
  return box;
}

TEST(MeshBoxes, CountAtLeastThePairsThatOverlapAndLittleWhereNoneDo) {
  const TriangleMesh one = hedgehog(150, 1);
  const TriangleMesh other = hedgehog(200, 2);
  const MeshBoxes a(one);
  const MeshBoxes b(other);
  for (const double away : {0.0, 0.7, 1.5, 2.5}) {
    const Eigen::Vector3f shift(static_cast<float>(away), 0, 0);
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < one.triangles.size(); ++i) {
      for (std::size_t j = 0; j < other.triangles.size(); ++j) {
        pairs += box_of(one, i).intersects(box_of(other, j).translated(shift)) ? 1 : 0;
      }
    }
    const Pose at{{away, 0, 0}, Quat::Identity()};
    const std::size_t tests = MeshBoxes::tests(a, Pose{}, b, at, SIZE_MAX);
    printf("%.1f m apart: %zu pairs of boxes overlap, %zu tests\n", away, pairs, tests);
    EXPECT_GE(tests, pairs);
    EXPECT_LE(tests, 2 * 150 * 200U);
    if (pairs == 0) {
      EXPECT_LT(tests, 10U);
    }
    EXPECT_EQ(MeshBoxes::tests(a, Pose{}, b, at, 20), std::min<std::size_t>(20, tests));
  }
}

desc::Model mesh_model(const char* name, const TriangleMesh& mesh, double z, bool is_static) {
  desc::Link link = box_link("link", 1.0, {1.0, 1.0, 1.0});
  link.collisions = {collision(mesh_shape(mesh))};
  desc::Model model = model_of(name, {link}, {{0, 0, z}, Quat::Identity()});
  model.is_static = is_static;
  return model;
}

// ODE alone takes minutes for a step of these.
TEST(MeshBoxes, TangledMeshesTakeNoLongerThanOthers) {
  for (const bool is_static : {false, true}) {
    TestWorld world;
    world.add(mesh_model("one", hedgehog(3000, 1), 2.0, is_static));
    const LinkId moving =
        world.only_link(world.add(mesh_model("two", hedgehog(3000, 2), 2.1, false)));
    const std::clock_t start = std::clock();
    world.run(3e-3);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    printf("3 steps of two tangled meshes: %.2f s\n", seconds);
    EXPECT_LT(seconds, 3.0);
    EXPECT_TRUE(world.crowded());
    if (!is_static) continue;
    world.run(0.2);
    EXPECT_LT(std::abs(world.link(moving).pose.position.z() - 2.1), 0.3) << "it is held or parted";
  }
}

}  // namespace
}  // namespace angen::physics::testing
