#include "sensors/sound_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace angen::sensors {
namespace {

constexpr double kAbsorption = 0.2;

double room_constant(double surface) { return surface * kAbsorption / (1.0 - kAbsorption); }

TEST(SoundField, ARoomByItselfHasFourOverItsRoomConstant) {
  const SoundField field({80.0, 50.0}, kAbsorption);
  EXPECT_NEAR(field.gains(0)[0], 4.0 / room_constant(80.0), 1e-12);
  EXPECT_NEAR(field.gains(1)[1], 4.0 / room_constant(50.0), 1e-12);
  EXPECT_EQ(field.gains(0)[1], 0.0);
}

// L2 = L1 - R + 10 lg(S / A2), EN ISO 12354-1.
TEST(SoundField, TwoRoomsDifferByTheReductionIndexOfTheirWall) {
  SoundField field({80.0, 50.0}, kAbsorption);
  const double wall = 10.0;
  field.pass(0, 1, wall * from_decibels(-40.0));
  const double own = to_decibels(field.gains(0)[0]);
  const double next = to_decibels(field.gains(1)[0]);
  EXPECT_NEAR(own - next, 40.0 - to_decibels(wall / (kAbsorption * 50.0)), 0.01);
}

TEST(SoundField, RoomsWithALargeOpeningAreOne) {
  SoundField field({80.0, 50.0}, kAbsorption);
  field.pass(0, 1, 1e7);
  const double whole = 4.0 / room_constant(130.0);
  EXPECT_NEAR(field.gains(0)[0], whole, 1e-6);
  EXPECT_NEAR(field.gains(0)[1], whole, 1e-6);
}

// The absorbed and the leaving parts of two watts add up to the emitted power.
TEST(SoundField, PowerIsBalanced) {
  SoundField field({80.0, 50.0, 60.0}, kAbsorption);
  field.pass(0, 1, 1.5);
  field.pass(1, 2, 0.3);
  field.pass(2, SoundField::kOutside, 0.8);
  double out = 0.0;
  const double surfaces[] = {80.0, 50.0, 60.0};
  for (int room = 0; room < 3; ++room) {
    const double irradiated = field.gains(room)[0] / 4.0;  // W/m^2, by a watt in room 0
    out += irradiated * (kAbsorption * surfaces[room] + (room == 2 ? 0.8 : 0.0));
  }
  EXPECT_NEAR(out, 1.0 - kAbsorption, 1e-12);
}

TEST(SoundField, EarAndSourceMayChangePlaces) {
  SoundField field({80.0, 50.0, 60.0}, kAbsorption);
  field.pass(0, 1, 1.5);
  field.pass(1, 2, 0.3);
  EXPECT_NEAR(field.gains(0)[2], field.gains(2)[0], 1e-15);
}

TEST(SoundField, DirectSoundFallsBySixDecibelsADoubleDistance) {
  EXPECT_NEAR(to_decibels(direct_gain(1.0, 1.0)), -10.992, 1e-3);
  EXPECT_NEAR(to_decibels(direct_gain(2.0, 1.0) / direct_gain(4.0, 1.0)), 6.0206, 1e-4);
  EXPECT_NEAR(to_decibels(direct_gain(3.0, 4.0) / direct_gain(3.0, 1.0)), 6.0206, 1e-4);
  EXPECT_TRUE(std::isfinite(direct_gain(0.0, 1.0)));
}

}  // namespace
}  // namespace angen::sensors
