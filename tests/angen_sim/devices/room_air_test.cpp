#include "devices/room_air.h"

#include <gtest/gtest.h>

#include <cmath>

namespace angen::devices {
namespace {

constexpr double kAirHeat = 1.204 * 1006.0;  // J/(m^3 K)

TEST(RoomAir, MoistureAndHumidityAreInverse) {
  // 50 % at 20 degrees: 1168 Pa of vapor, 7.25 g/kg
  EXPECT_NEAR(moisture_of(20.0, 50.0), 0.00725, 2e-5);
  for (const double humidity : {5.0, 50.0, 100.0}) {
    EXPECT_NEAR(humidity_of({25.0, moisture_of(25.0, humidity)}), humidity, 1e-9);
  }
  EXPECT_EQ(humidity_of({0.0, moisture_of(30.0, 100.0)}), 100.0);  // the excess condenses
}

TEST(RoomAir, AClosedRoomWarmsByItsHeatAndLosesNone) {
  RoomAir air({}, {30.0, 20.0}, {20.0, 0.005});
  air.step(60.0, {-10.0, 0.0}, {1000.0, 0.0}, {});
  EXPECT_NEAR(air.rooms()[0].temperature, 20.0 + 60.0 * 1000.0 / (kAirHeat * 30.0), 1e-9);
  EXPECT_EQ(air.rooms()[1].temperature, 20.0);
  EXPECT_EQ(air.rooms()[0].moisture, 0.005);
}

TEST(RoomAir, ALeakyRoomBecomesAsTheAirOutside) {
  RoomAir::Settings settings;
  settings.heat_loss = 0.5;
  settings.air_change = 0.5 / 3600.0;
  RoomAir air(settings, {30.0}, {20.0, 0.003});
  const double loss = settings.heat_loss + kAirHeat * settings.air_change;
  const double seconds = 2.0 * kAirHeat / loss;  // two time constants
  for (int i = 0; i < 10'000; ++i) air.step(seconds / 10'000, {0.0, 0.001}, {0.0}, {});
  EXPECT_NEAR(air.rooms()[0].temperature, 20.0 * std::exp(-2.0), 0.01);
  EXPECT_NEAR(air.rooms()[0].moisture, 0.001 + 0.002 * std::exp(-settings.air_change * seconds),
              1e-5);
}

TEST(RoomAir, RadiatorsBalanceTheLossBelowTheTemperatureOfTheirValves) {
  RoomAir::Settings settings;
  settings.heat_loss = 0.6;
  settings.heating_power = 40.0;
  RoomAir air(settings, {30.0, 30.0}, {25.0, 0.003});
  air.heat_to(21.0);
  const Air outside{5.0, 0.003};
  for (int i = 0; i < 100'000; ++i) air.step(1.0, outside, {0.0, 600.0}, {});
  // 0.6 (T - 5) = 40 (21 - T) / 2
  EXPECT_NEAR(air.rooms()[0].temperature, (0.6 * 5.0 + 20.0 * 21.0) / 20.6, 1e-6);
  EXPECT_NEAR(air.rooms()[1].temperature, 5.0 + 20.0 / 0.6, 1e-6);  // 20 W/m^3 without radiators
  for (int i = 0; i < 100'000; ++i) air.step(1.0, {-60.0, 0.0}, {0.0, 0.0}, {});
  EXPECT_NEAR(air.rooms()[0].temperature, -60.0 + 40.0 / 0.6, 1e-6);  // too cold for them
}

TEST(RoomAir, ThroughADoorwayWhatOneRoomLosesTheOtherGains) {
  const Opening door{0, 1, 0.9, 2.0};
  const Air warm{22.0, 0.0}, cold{18.0, 0.0};
  const double middle = 293.15;
  EXPECT_NEAR(doorway_flow(door, warm, cold), 0.2 * 0.9 * std::sqrt(9.81 * 8.0 * 4.0 / middle),
              1e-9);
  EXPECT_EQ(doorway_flow(door, warm, warm), 0.0);
  RoomAir air({}, {30.0, 30.0}, cold);
  air.fill(0, warm);
  for (int i = 0; i < 1800; ++i) air.step(1.0, {}, {0.0, 0.0}, {door});
  EXPECT_NEAR(air.rooms()[0].temperature + air.rooms()[1].temperature, 40.0, 1e-9);
  EXPECT_NEAR(air.rooms()[0].temperature - air.rooms()[1].temperature, 0.0, 0.1);
}

}  // namespace
}  // namespace angen::devices
