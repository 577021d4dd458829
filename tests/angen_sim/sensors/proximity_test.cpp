#include "sensors/proximity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench.h"

namespace angen {
namespace {

using test::at;
using test::Bench;
using test::box;
using test::element;
using test::plugin_element;

const char* const kRange = "libgazebo_ros_range.so";
const char* const kSonar = "libhector_gazebo_ros_sonar.so";

Element cone(double wide, double high) {
  const Element scan = element("scan", "",
                               {test::scan("horizontal", 7, -wide / 2, wide / 2),
                                test::scan("vertical", 3, -high / 2, high / 2)});
  const Element range = element("range", "", {element("min", "0.05"), element("max", "2.5")});
  return test::sensor_element({element("ray", "", {scan, range})});
}

TEST(Proximity, IsTheNearestOfItsRays) {
  for (const char* library : {kRange, kSonar}) {
    Bench bench(library, plugin_element({}), cone(0.4, 0.2));
    bench.add(box(0.2, 10, 10), at(2.1));
    EXPECT_NEAR(bench.sample().get<double>("range"), 2.0, 1e-9) << library;
    bench.add(box(0.2, 0.2, 0.2), at(1.1, 0.2));  // in the left of the cone
    const double nearest = bench.sample().get<double>("range");
    EXPECT_GE(nearest, 1.0);
    EXPECT_LT(nearest, 1.1) << library;
  }
}

TEST(Proximity, ItsMessageSaysTheFovOfThePlugin) {
  Bench plain(kRange, plugin_element({}), cone(0.4, 0.2));
  EXPECT_NEAR(plain.sample().get<double>("field_of_view"), 0.4, 1e-12);
  Bench given(kRange, plugin_element({{"fov", "0.05"}, {"radiation", "infrared"}}), cone(0.4, 0.2));
  const Reading reading = given.sample();
  EXPECT_EQ(reading.get<double>("field_of_view"), 0.05);
  EXPECT_TRUE(reading.get<bool>("infrared"));
  EXPECT_EQ(reading.get<double>("max_range"), 2.5);
  Bench sonar(kSonar, plugin_element({}), cone(0.4, 0.2));
  EXPECT_NEAR(sonar.sample().get<double>("field_of_view"), 0.2, 1e-12);
  EXPECT_FALSE(sonar.sample().get<bool>("infrared"));
}

TEST(Proximity, GaussianNoiseIsOnItsRange) {
  for (const char* library : {kRange, kSonar}) {
    Bench bench(library, plugin_element({{"gaussianNoise", "0.02"}}), cone(0.4, 0.2));
    bench.add(box(0.2, 10, 10), at(2.1));
    double squares = 0.0;
    for (int i = 0; i < 2000; ++i) {
      squares += std::pow(bench.sample().get<double>("range") - 2.0, 2);
    }
    EXPECT_NEAR(std::sqrt(squares / 2000), 0.02, 0.0015) << library;
  }
}

}  // namespace
}  // namespace angen
