#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string gps(const std::string& more) {
  return "<plugin name='g' filename='libhector_gazebo_ros_gps.so'><bodyName>body</bodyName>" +
         more + "</plugin>";
}

std::string at(const std::string& place, const std::string& more) {
  return "<model name='bot'><static>true</static><pose>" + place +
         " 0 0 0</pose><link name='body'/>" + gps(more) + "</model>";
}

// A degree of latitude at 49.9 degrees is 111.23 km, one of longitude 71.84 km (WGS 84).
TEST(Gps, IsAsFarNorthAndEastAsTheEllipsoidSays) {
  Hall hall(at("1000 2000 30", ""));
  hall.request("gps");
  hall.run(0.5);
  const Reading fix = hall.reading("gps");
  EXPECT_NEAR((fix.get<double>("latitude") - 49.9) * 111.227, 1.0, 1e-3);
  EXPECT_NEAR((fix.get<double>("longitude") - 8.9) * 71.8445, -2.0, 1e-4);
  EXPECT_NEAR(fix.get<double>("altitude"), 30.0, 1e-9);
}

TEST(Gps, ItsHeadingTurnsTheWorld) {
  Hall hall(at("1000 0 0",
               "<referenceHeading>90</referenceHeading><referenceLatitude>0"
               "</referenceLatitude><referenceLongitude>0</referenceLongitude>"));
  hall.request("gps");
  hall.run(0.5);
  const Reading fix = hall.reading("gps");  // x points east
  EXPECT_NEAR(fix.get<double>("latitude"), 0.0, 1e-9);
  EXPECT_NEAR(fix.get<double>("longitude") * 111.3195, 1.0, 1e-4);
}

TEST(Gps, HasNoiseAndItsVariance) {
  Hall hall(at("0 0 0", "<gaussianNoise>1 1 3</gaussianNoise><updateRate>1000</updateRate>"));
  hall.request("gps");
  double squares = 0.0;
  for (int i = 0; i < 2000; ++i) {
    hall.run(0.001);
    squares += std::pow(hall.reading("gps").get<double>("altitude"), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 2000), 3.0, 0.2);
  EXPECT_EQ(list(hall.reading("gps"), "variances"), (std::vector<double>{1.0, 1.0, 9.0}));
}

TEST(Gps, ItsVelocityIsTheLinks) {
  Hall hall(robot(plugin("planar_move", "") + gps("")));
  hall.request("gps");
  hall.run(0.5);
  hall.command("planar_move", {0.3, 0.1, 0.0});
  hall.run(1.0);
  const std::vector<double> velocity = list(hall.reading("gps"), "velocity");
  EXPECT_NEAR(velocity[0], 0.3, 0.02);
  EXPECT_NEAR(velocity[1], 0.1, 0.02);
}

}  // namespace
}  // namespace angen::robots
