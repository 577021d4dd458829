#include "assets/ies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

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
