// Standing shapes of a scene, and their changes.
#include <gtest/gtest.h>

#include "shapes.h"

namespace angen::rays::testing {
namespace {

using Indices = std::vector<std::uint32_t>;

TEST(Standing, IsWhatIsStaticOrAnchored) {
  Scene scene;
  const ShapeId wall = add(scene, box(1, 1, 1), at(8, 0, 0));
  const ShapeId door = add(scene, box(1, 1, 1), at(4, 0, 0), Mobility::kAnchored);
  const ShapeId person = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
  const ShapeId nothing = add(scene, Shape{});
  scene.commit();
  ASSERT_TRUE(scene.standing(wall.index) && scene.standing(door.index));
  EXPECT_TRUE(scene.standing(wall.index)->is_static);
  EXPECT_FALSE(scene.standing(door.index)->is_static);
  EXPECT_EQ(scene.standing(door.index)->id, door);
  EXPECT_EQ(scene.standing(door.index)->box.min().x(), 3.5);
  EXPECT_FALSE(scene.standing(person.index));
  EXPECT_FALSE(scene.standing(nothing.index));
  EXPECT_FALSE(scene.standing(99));
  scene.remove(wall);
  EXPECT_FALSE(scene.standing(wall.index));
}

TEST(Standing, ChangesAreThoseSinceTheMark) {
  Scene scene;
  const ShapeId wall = add(scene, box(1, 1, 1), at(8, 0, 0));
  const ShapeId door = add(scene, box(1, 1, 1), at(4, 0, 0), Mobility::kAnchored);
  const ShapeId person = add(scene, box(1, 1, 1), at(2, 0, 0), Mobility::kMoving);
  std::uint64_t mark = 0, other = 0;
  EXPECT_EQ(scene.standing_changes(mark), (Indices{0, 1, 2}));
  EXPECT_EQ(scene.standing_changes(mark), Indices{});
  scene.move(person, at(1, 0, 0));
  EXPECT_EQ(scene.standing_changes(mark), Indices{});
  scene.move(door, at(5, 0, 0));
  scene.move(wall, at(9, 0, 0));
  scene.move(door, at(6, 0, 0));
  EXPECT_EQ(scene.standing_changes(mark), (Indices{wall.index, door.index}));
  scene.set_anchored(person, true);
  EXPECT_EQ(scene.standing_changes(mark), Indices{person.index});
  scene.set_anchored(person, false);
  scene.remove(wall);
  EXPECT_EQ(scene.standing_changes(mark), (Indices{wall.index, person.index}));
  EXPECT_EQ(scene.standing_changes(other), (Indices{0, 1, 2}));
}

TEST(Standing, WhoAsksAfterVeryManyChangesIsToldOfAll) {
  Scene scene;
  add(scene, box(1, 1, 1), at(8, 0, 0));
  const ShapeId door = add(scene, box(1, 1, 1), at(4, 0, 0), Mobility::kAnchored);
  std::uint64_t often = 0, late = 0;
  scene.standing_changes(often);
  scene.standing_changes(late);
  for (int i = 1; i <= 20000; ++i) {
    scene.move(door, at(4, 0, 1e-3 * i));
    EXPECT_EQ(scene.standing_changes(often), Indices{door.index});
  }
  EXPECT_EQ(scene.standing_changes(late), (Indices{0, 1}));
  EXPECT_EQ(scene.standing_changes(late), Indices{});
}

}  // namespace
}  // namespace angen::rays::testing
