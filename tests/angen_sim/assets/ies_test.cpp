#include "assets/ies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/diagnostics.h"

namespace angen::load {
namespace {

const std::string kHead = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] nobody\nTILT=NONE\n";
const std::string kNumbers = "1 1000 2.0 3 2 1 2 0.1 0.1 0\n1 1 10\n";
const std::string kAngles = "0 45 90\n0 90\n";

std::string error_of(const std::string& text) {
  try {
    photometry_of(text, "lamp.ies");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Ies, HasItsAnglesAndItsIntensitiesTimesTheMultiplier) {
  const Photometry read =
      photometry_of(kHead + kNumbers + kAngles + "100 70,\r\n 0\n90 60 5\n", "lamp.ies");
  ASSERT_EQ(read.vertical.size(), 3U);
  EXPECT_DOUBLE_EQ(read.vertical[1], M_PI / 4);
  ASSERT_EQ(read.horizontal.size(), 2U);
  EXPECT_DOUBLE_EQ(read.horizontal[1], M_PI / 2);
  EXPECT_EQ(read.candela, (std::vector<double>{200, 140, 0, 180, 120, 10}));
}

// LM-63: such a luminaire is symmetric about the plane of 90 and 270 degrees.
TEST(Ies, PlanesFrom90To270AreMirrored) {
  const auto candela_of = [](const Photometry& luminaire, int degrees) {
    for (std::size_t i = 0; i < luminaire.horizontal.size(); ++i) {
      if (std::abs(luminaire.horizontal[i] - degrees * M_PI / 180.0) > 1e-9) continue;
      return luminaire.candela[2 * i];
    }
    return -1.0;
  };
  const std::string numbers = "1 1000 1 2 4 1 2 0.1 0.1 0\n1 1 10\n0 90\n";
  const Photometry read =
      photometry_of(kHead + numbers + "90 150 180 270\n100 0\n50 0\n30 0\n10 0\n", "lamp.ies");
  EXPECT_EQ(read.horizontal.size(), 7U);
  for (const auto& [degrees, candela] : {std::pair{0, 30.0},
                                         {30, 50.0},
                                         {90, 100.0},
                                         {150, 50.0},
                                         {180, 30.0},
                                         {270, 10.0},
                                         {360, 30.0}}) {
    EXPECT_EQ(candela_of(read, degrees), candela) << degrees;
  }
  const Photometry without =
      photometry_of(kHead + numbers + "90 140 200 270\n100 0\n50 0\n30 0\n10 0\n", "lamp.ies");
  for (const auto& [degrees, candela] : {std::pair{0, 110.0 / 3.0},
                                         {40, 50.0},
                                         {140, 50.0},
                                         {180, 110.0 / 3.0},
                                         {200, 30.0},
                                         {340, 30.0},
                                         {360, 110.0 / 3.0}}) {
    EXPECT_NEAR(candela_of(without, degrees), candela, 1e-9) << degrees;
  }
}

TEST(Ies, ABrokenFileIsAnErrorWithItsLine) {
  const auto expect = [](const std::string& text, const std::string& line,
                         const std::string& message) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find("lamp.ies:" + line + ": "), std::string::npos) << error;
    EXPECT_NE(error.find(message), std::string::npos) << error;
  };
  expect("", "1", "TILT=NONE");
  expect("a cake\n2 eggs\n", "2", "TILT=NONE");
  expect("IESNA:LM-63-2002\nTILT=INCLUDE\n1\n", "2", "TILT=INCLUDE");
  expect(kHead + "1 1000 2.0 three 2 1 2 0 0 0\n", "5", "'three' is not a number");
  expect(kHead + "1 1000 0 3 2 1 2 0 0 0\n", "5", "multiplier");
  expect(kHead + "1 1000 1 2.5 2 1 2 0 0 0\n", "5", "number of vertical angles");
  expect(kHead + "1 1000 1 3 99999999 1 2 0 0 0\n", "5", "number of horizontal angles");
  expect(kHead + "1 1000 1 3 2 2 2 0 0 0\n", "5", "type C");
  expect(kHead + "1 1000 1 3 2 3 2 0 0 0\n", "5", "type C");
  expect(kHead + "1 1000 1 3 2 1 7 0 0 0\n", "5", "unit");
  expect(kHead + kNumbers + "0 45 40\n", "7", "do not ascend");
  expect(kHead + kNumbers + "0 45 80\n0 90\n", "7", "vertical angles do not go");
  expect(kHead + kNumbers + "0 45 90\n0 100\n", "8", "horizontal angles do not go");
  expect(kHead + kNumbers + kAngles + "100 70 0\n90 nan 5\n", "10", "'nan' is not a number");
  expect(kHead + kNumbers + kAngles + "100 70 0\n90 -1 5\n", "10", "below 0");
  expect(kHead + kNumbers + kAngles + "0 0 0\n0 0 0\n", "10", "all intensities are 0");
  expect(kHead + kNumbers + kAngles + "100 70 0\n90\n", "10", "the file ends");
}

}  // namespace
}  // namespace angen::load
