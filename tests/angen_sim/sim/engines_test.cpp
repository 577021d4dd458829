#include "sim/engines.h"

#include <gtest/gtest.h>

namespace angen::sim {
namespace {

desc::Collision box(const std::string& name, const Vec3& size, const Vec3& at) {
  desc::Collision collision;
  collision.name = name;
  collision.pose.position = at;
  collision.shape.type = Shape::Type::kBox;
  collision.shape.size = size;
  return collision;
}

/// A body of 2 x 0.4 m that lies down, on a floor.
struct Body {
  Engines engines{desc::World{}, 0};
  Parts parts;
  std::int64_t tick = 0;

  Body() {
    desc::Model floor;
    floor.name = "floor";
    floor.is_static = true;
    floor.links.emplace_back();
    floor.links[0].name = "link";
    floor.links[0].collisions = {box("c", {10.0, 10.0, 1.0}, {0.0, 0.0, -0.5})};
    engines.add(floor);
    desc::Model model;
    model.name = "it";
    model.pose.position.z() = 0.001;
    model.links.emplace_back();
    model.links[0].name = "link";
    model.links[0].inertial.pose.position.z() = 0.1;
    model.links[0].collisions = {box("stands", {0.4, 0.4, 2.0}, {0.0, 0.0, 1.0}),
                                 box("lies", {2.0, 0.4, 0.4}, {0.0, 0.0, 0.2})};
    model.links[0].anatomy = {true, 0.0, {}, {{"stands"}, {"lies"}}};
    parts = engines.add(model);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) engines.physics.step(++tick);
    engines.follow(parts, 0);
  }
  double height() {
    engines.rays.commit();
    const rays::Ray ray{{0.0, 0.0, 5.0}, -Vec3::UnitZ()};
    rays::Hit hit;
    engines.rays.cast(&ray, &hit, 1);
    return 5.0 - hit.range;
  }
};

TEST(Engines, CollisionsOfOnePostureTouchAndAreHit) {
  Body body;
  body.run(200);
  EXPECT_NEAR(body.height(), 2.0, 0.01);
  body.engines.take_posture(body.parts, 0, 1, {{0.0, 0.0, 0.5}, Quat::Identity()});
  EXPECT_NEAR(body.height(), 0.9, 1e-9);
  body.run(500);
  EXPECT_NEAR(body.height(), 0.4, 0.01);  // it fell onto the floor, and stays on it
  for (const ContactPair& pair : body.engines.physics.contacts()) {
    EXPECT_EQ((pair.first + pair.second).find("stands"), std::string::npos);
  }
  body.engines.take_posture(body.parts, 0, 0, {{0.0, 0.0, 0.001}, Quat::Identity()});
  body.run(200);
  EXPECT_NEAR(body.height(), 2.0, 0.01);
  EXPECT_FALSE(body.engines.physics.contacts().empty());
}

}  // namespace
}  // namespace angen::sim
