#include <angen_msgs/BarometerMsg.h>
#include <gtest/gtest.h>

#include <cmath>

#include "angen_sim/ros/messages.h"
#include "sdf/load.h"
#include "sim/simulation.h"

namespace angen::node {
namespace {

/// The reading of a barometer at that height, in air of `kelvin`.
angen_msgs::BarometerMsg message_at(double height, double kelvin, const std::string& parameters) {
  const std::string world =
      "<sdf version='1.6'><world name='w'><gravity>0 0 -9.80665</gravity><atmosphere "
      "type='adiabatic'><temperature>" +
      std::to_string(kelvin) + "</temperature></atmosphere><model name='b'><static>true</static>" +
      "<pose>3 4 " + std::to_string(height) +
      " 1 2 3</pose><link name='l'><sensor name='s' type='custom'><plugin name='p' "
      "filename='libbarometer.so'>" +
      parameters + "</plugin></sensor></link></model></world></sdf>";
  sim::Simulation simulation(load::world_from_text(world, "text", {}), 5,
                             std::make_shared<Catalog>());
  simulation.tick();
  angen_msgs::BarometerMsg message;
  fill("barometer", *simulation.snapshot()->reading(0), {}, message);
  return message;
}

// p = p0 exp(-M g z / R T), of air that is as warm everywhere.
TEST(Barometer, PressureFallsWithHeightAsThatOfUniformAirDoes) {
  for (const double kelvin : {253.15, 295.15}) {
    for (const double height : {-3.0, 0.0, 2.8, 300.0}) {
      const double fall = 0.0289644 * 9.80665 * height / (8.314462618 * kelvin);
      const double expected = 99000.0 * std::exp(-fall);
      const auto message = message_at(height, kelvin, "<ground_pressure>99000</ground_pressure>");
      EXPECT_NEAR(message.pressure, expected, 1e-6) << height;
    }
  }
}

// In air of the standard's temperature, its altitude is the height.
TEST(Barometer, ItsAltitudeIsThatOfTheStandardAtmosphere) {
  EXPECT_NEAR(message_at(10.0, 288.15, "").altitude, 10.0, 0.01);
  EXPECT_NEAR(message_at(10.0, 295.15, "").altitude, 10.0 * 288.15 / 295.15, 0.01);
  const auto message = message_at(0.0, 288.15, "<ground_pressure>89874.6</ground_pressure>");
  EXPECT_NEAR(message.altitude, 1000.0, 0.01);  // as the table of ISO 2533 has it
}

TEST(Barometer, ItsNoiseHasItsVariance) {
  const auto message = message_at(0.0, 288.15, "<noise_stddev>1.3</noise_stddev>");
  EXPECT_DOUBLE_EQ(message.variance, 1.69);
  EXPECT_NE(message.pressure, 101325.0);
  EXPECT_NEAR(message.pressure, 101325.0, 10.0);
}

}  // namespace
}  // namespace angen::node
