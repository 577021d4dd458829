#include <gtest/gtest.h>

#include "home/survey.h"

namespace angen {
namespace {

/// Boxes from low to high z on a floor of `side` m, of a static model.
class House {
 public:
  House() { model_.is_static = true; }

  House& box(double low, double high, double length, double width = 0.1) {
    desc::Collision collision;
    collision.shape.type = Shape::Type::kBox;
    collision.shape.size = {length, width, high - low};
    collision.pose.position.z() = (low + high) / 2;
    return add(collision);
  }
  House& ground(double z) {
    desc::Collision collision;
    collision.shape.type = Shape::Type::kPlane;
    collision.pose.position.z() = z;
    return add(collision);
  }
  /// A sheet of 8 x 8 m at z, of whose side a ramp leads up to `high`, to a step of 1 x 8 m.
  House& ramp(double z, double high) {
    auto mesh = std::make_shared<TriangleMesh>();
    const std::pair<double, double> profile[] = {{0, z}, {8, z}, {10, high}, {11, high}};
    for (const auto& [x, height] : profile) {
      for (const double y : {0.0, 8.0}) mesh->vertices.push_back(Vec3(x, y, height).cast<float>());
    }
    for (std::uint32_t i = 0; i < 6; i += 2) {
      mesh->triangles.push_back({i, i + 2, i + 1});
      mesh->triangles.push_back({i + 1, i + 2, i + 3});
    }
    desc::Collision collision;
    collision.shape.type = Shape::Type::kMesh;
    collision.shape.mesh = mesh;
    return add(collision);
  }
  House& slab(double top, double side = 8.0) { return box(top - 0.2, top, side, side); }

  std::vector<double> floors() const {
    std::vector<double> found;
    for (const Storey& storey : storeys_of({}, {{&model_, model_.pose}})) {
      EXPECT_EQ(storey.number, static_cast<int>(found.size()));
      found.push_back(storey.elevation);
    }
    return found;
  }

  desc::Model& model() { return model_; }

 private:
  House& add(const desc::Collision& collision) {
    desc::Link link;
    link.collisions.push_back(collision);
    model_.links.push_back(link);
    return *this;
  }

  desc::Model model_;
};

using Floors = std::vector<double>;

TEST(Storeys, AreTheFloorsOnWhichWallsStand) {
  House house;
  house.ground(0.0).box(0.0, 2.6, 8.0).slab(2.8).box(2.8, 5.3, 8.0).slab(5.5).box(5.5, 8.0, 8.0);
  EXPECT_EQ(house.floors(), (Floors{0.0, 2.8, 5.5})) << "not the ceiling";
  house.model().pose.position.z() = 1.0;
  EXPECT_EQ(house.floors(), (Floors{1.0, 3.8, 6.5}));
}

TEST(Storeys, AreAlsoFloorsThatWallsPass) {
  House house;
  house.slab(0.1).box(0.0, 6.0, 8.0).slab(3.1).slab(6.2);
  EXPECT_EQ(house.floors(), (Floors{0.1, 3.1})) << "nothing stands on the roof";
}

TEST(Storeys, AreNeitherFurnitureNorLintelsNorCeilings) {
  House house;
  house.ground(0.0).slab(0.08).box(0.08, 4.0, 8.0);
  house.box(0.85, 0.9, 3.0, 2.0);  // a large table
  house.box(1.4, 2.5, 0.8, 0.3);   // a cabinet on a wall
  house.box(2.1, 4.0, 1.0);        // the wall above a door
  house.box(2.55, 2.6, 7.9, 7.9);  // a suspended ceiling
  house.slab(4.2).box(4.2, 6.8, 8.0);
  const Floors floors = house.floors();
  ASSERT_EQ(floors.size(), 2U);
  EXPECT_NEAR(floors[0], 0.08, 1e-9) << "the floor, and not the ground below it";
  EXPECT_NEAR(floors[1], 4.2, 1e-9);
}

TEST(Storeys, AreOneWhereWallsHaveNoFloor) {
  EXPECT_EQ(House().box(0.25, 2.5, 8.0).box(1.5, 2.75, 1.0).floors(), (Floors{0.25}));
  EXPECT_EQ(House().ground(0.0).floors(), Floors{}) << "no walls";
  House cabinet;
  cabinet.box(0.0, 2.0, 1.0).ground(0.0).model().home.thing = "wardrobe";
  EXPECT_EQ(cabinet.floors(), Floors{});
}

TEST(Storeys, AreWhereMostOfAMeshLiesFlat) {
  const Floors floors = House().ramp(0.02, 0.18).box(0.02, 3.0, 8.0).floors();
  ASSERT_EQ(floors.size(), 1U);
  EXPECT_NEAR(floors[0], 0.02, 1e-3) << "not the end of its ramp";
}

/// Doors at these heights, each a model.
std::vector<desc::Model> doors(const Floors& heights, double high) {
  std::vector<desc::Model> models;
  for (const double z : heights) {
    desc::Model model;
    model.pose.position.z() = z;
    desc::Link leaf;
    leaf.name = "leaf";
    desc::Collision collision;
    collision.shape.type = Shape::Type::kBox;
    collision.shape.size = {0.9, 0.04, high};
    collision.pose.position.z() = high / 2;
    leaf.collisions.push_back(collision);
    model.links = {leaf};
    desc::Joint fixed;
    fixed.parent = "world";
    fixed.child = "base";
    desc::Joint hinge;
    hinge.type = desc::Joint::Type::kRevolute;
    hinge.parent = "base";
    hinge.child = "leaf";
    hinge.axes.resize(1);
    hinge.axes[0].xyz = Vec3::UnitZ();
    model.joints = {fixed, hinge};
    models.push_back(model);
  }
  return models;
}

Floors floors_with(House& house, const std::vector<desc::Model>& doors) {
  std::vector<std::pair<const desc::Model*, Pose>> models = {{&house.model(), Pose{}}};
  for (const desc::Model& door : doors) models.emplace_back(&door, door.pose);
  Floors found;
  for (const Storey& storey : storeys_of({}, models)) found.push_back(storey.elevation);
  return found;
}

TEST(Storeys, AreAlsoWhereDoorsStandWithoutFloorsThatAreKnown) {
  House nothing;
  EXPECT_EQ(floors_with(nothing, doors({0.25, 4.0}, 2.0)), (Floors{0.25, 4.0}));
  EXPECT_EQ(floors_with(nothing, doors({3.0, 3.5, 3.0}, 2.0)), (Floors{3.0}));
  House ground;
  ground.ground(0.0);
  EXPECT_EQ(floors_with(ground, doors({3.0}, 2.0)), (Floors{0.0, 3.0}));
  EXPECT_EQ(floors_with(ground, doors({0.5}, 2.0)), (Floors{0.0}));
  House house;
  house.slab(0.0).box(0.0, 6.0, 8.0);
  EXPECT_EQ(floors_with(house, doors({0.0, 2.75}, 2.0)), (Floors{0.0, 2.75}));
  EXPECT_EQ(floors_with(house, doors({0.0, 2.75}, 1.2)), (Floors{0.0})) << "windows";
}

}  // namespace
}  // namespace angen
