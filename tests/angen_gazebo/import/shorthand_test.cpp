#include <gtest/gtest.h>

#include <set>

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

std::string population(const std::string& more) {
  return in_world(
      "<population name='p'><pose>10 0 0 0 0 0</pose><model name='can'><link name='l'/>"
      "</model>" +
      more + "</population>");
}

std::vector<double> xs_of(const desc::World& world) {
  std::vector<double> xs;
  for (const desc::Model& model : world.models) xs.push_back(model.pose.position.x());
  return xs;
}

TEST(Shorthand, AGridStandsAroundItsPose) {
  const desc::World world =
      read(population("<distribution><type>grid</type><rows>2</rows><cols>3</cols>"
                      "<step>1 2 0</step></distribution>"));
  ASSERT_EQ(world.models.size(), 6U);
  EXPECT_EQ(world.models[0].name, "can_clone_0");
  EXPECT_EQ(xs_of(world), (std::vector<double>{9, 10, 11, 9, 10, 11}));
  EXPECT_EQ(world.models[5].pose.position.y(), 1.0);
}

TEST(Shorthand, ALineIsEvenAndCentered) {
  const desc::World world =
      read(population("<model_count>4</model_count><box><size>8 1 1</size></box>"
                      "<distribution><type>linear-x</type></distribution>"));
  EXPECT_EQ(xs_of(world), (std::vector<double>{7, 9, 11, 13}));
}

TEST(Shorthand, WhatIsStrewnStaysInItsRegionAndInItsPlaces) {
  for (const char* type : {"random", "uniform"}) {
    const std::string text = population(
        "<model_count>50</model_count><cylinder><radius>2</radius><length>1</length>"
        "</cylinder><distribution><type>" +
        std::string(type) + "</type></distribution>");
    const desc::World world = read(text);
    ASSERT_EQ(world.models.size(), 50U);
    std::set<double> places;
    for (const desc::Model& model : world.models) {
      const Vec3 from = model.pose.position - Vec3(10, 0, 0);
      EXPECT_LE(from.head<2>().norm(), 2.0);
      EXPECT_LE(std::abs(from.z()), 0.5);
      places.insert(from.x());
    }
    EXPECT_EQ(places.size(), 50U);
    EXPECT_EQ(xs_of(read(text)), xs_of(world));
  }
}

TEST(Shorthand, WrongOnesAreErrors) {
  EXPECT_NE(error_of(population("<distribution><type>spiral</type></distribution>"))
                .find("unknown <distribution> 'spiral'"),
            std::string::npos);
  EXPECT_NE(error_of(population("<model_count>1.5</model_count>")).find("give a whole number"),
            std::string::npos);
  EXPECT_NE(error_of(in_world("<population name='p'/>")).find("has no <model>"), std::string::npos);
  EXPECT_NE(error_of(in_world("<road name='r'><point>0 0 0</point></road>")).find("has 1 <point>"),
            std::string::npos);
}

TEST(Shorthand, ARoadIsBoxesFromPointToPoint) {
  const desc::World world =
      read(in_world("<road name='r'><width>2</width><point>0 0 0</point><point>4 0 0</point>"
                    "<point>4 3 0</point></road>"));
  ASSERT_EQ(world.models.size(), 1U);
  EXPECT_TRUE(world.models[0].is_static);
  const std::vector<desc::Visual>& parts = world.models[0].links[0].visuals;
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].shape.size.head<2>(), Eigen::Vector2d(4, 2));
  EXPECT_EQ(parts[1].shape.size.head<2>(), Eigen::Vector2d(3, 2));
  expect_near(parts[1].pose.position, Vec3(4, 1.5, parts[0].pose.position.z()));
  EXPECT_TRUE(world.models[0].links[0].collisions.empty());
}

}  // namespace
}  // namespace angen::load
