#include "record/json_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace angen::record {
namespace {

double number_in(const std::string& text) {
  const std::string line = "{\"x\":" + text + "}";
  return LineReader(line, {"a.log", 3}, 100).get<double>("x");
}

std::string wrong_with(const std::string& text) {
  try {
    number_in(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(JsonLine, NumbersAreReadAsTheyWereWritten) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double most = std::numeric_limits<double>::max();
  std::uint64_t sum = 0;
  const std::string line = LineWriter()
                               .add("x", std::vector<double>{0.1, -0.0, 1.0 / 3.0, tiny, -most, 3.0,
                                                             INFINITY, -INFINITY, std::nan("")})
                               .add("n", std::numeric_limits<std::uint64_t>::max())
                               .done(sum);
  const std::string text = line.substr(0, line.size() - 1);
  const LineReader reader(text, {"a.log", 1}, 0);
  const auto numbers = reader.get<std::vector<double>>("x");
  ASSERT_EQ(numbers.size(), 9U);
  EXPECT_EQ(numbers[0], 0.1);
  EXPECT_TRUE(std::signbit(numbers[1]));
  EXPECT_EQ(numbers[2], 1.0 / 3.0);
  EXPECT_EQ(numbers[3], tiny);
  EXPECT_EQ(numbers[4], -most);
  EXPECT_EQ(numbers[5], 3.0);
  EXPECT_EQ(numbers[6], INFINITY);
  EXPECT_EQ(numbers[7], -INFINITY);
  EXPECT_TRUE(std::isnan(numbers[8]));
  EXPECT_EQ(reader.get<std::uint64_t>("n"), std::numeric_limits<std::uint64_t>::max());
}

TEST(JsonLine, ManyZerosAndLargeExponentsAreNumbersToo) {
  EXPECT_EQ(number_in("0e-300"), 0.0);
  EXPECT_EQ(number_in("0." + std::string(4000, '0')), 0.0);
  EXPECT_EQ(number_in("0." + std::string(300, '0') + "1"), 1e-301);
  EXPECT_EQ(number_in("1" + std::string(300, '0') + "." + std::string(900, '1')), 1e300);
  EXPECT_EQ(number_in("-7"), -7.0);
}

TEST(JsonLine, ANumberThatNoDoubleHoldsIsAnErrorWithItsPlace) {
  const std::string begin = "a.log:3: is damaged at byte 105 of the file: ";
  const std::string none = begin + "A number that no double can hold.";
  EXPECT_EQ(wrong_with("0." + std::string(4000, '0') + "1"), none);
  EXPECT_EQ(wrong_with("1e-400"), none);
  EXPECT_EQ(wrong_with("1e-99999999999999999999"), none);
  EXPECT_EQ(wrong_with("1e400").find(begin), 0U);
}

TEST(JsonLine, ATextIsNotANumberNorTheOtherWayRound) {
  const std::string missing = "is missing, or not a ";
  EXPECT_NE(wrong_with("\"1\"").find("'x' " + missing + "number"), std::string::npos);
  const std::string line = "{\"x\":1.5}";
  EXPECT_THROW(LineReader(line, {"a.log", 1}, 0).get<std::string>("x"), Error);
  EXPECT_THROW(LineReader(line, {"a.log", 1}, 0).get<std::uint64_t>("x"), Error);
}

}  // namespace
}  // namespace angen::record
