#include "plugin/reading.h"

#include <gtest/gtest.h>

#include "core/diagnostics.h"

namespace angen {
namespace {

template <class F>
std::string thrown(F&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Reading, AnIntegerIsReadAsANumberToo) {
  Reading reading;
  reading.set("count", 3);
  EXPECT_EQ(reading.get<std::int64_t>("count"), 3);
  EXPECT_EQ(reading.get<double>("count"), 3.0);
  EXPECT_EQ(reading.get<double>("count", 7.0), 3.0);
}

TEST(Reading, ANumberStaysANumberWhereItIsSetToAnInteger) {
  Reading reading;
  reading.set("distance", 0.5);
  reading.set("distance", 2);
  ASSERT_NE(reading.get_if<double>("distance"), nullptr);
  EXPECT_EQ(reading.get<double>("distance"), 2.0);
}

TEST(Reading, AMissingFieldIsAnErrorThatNamesTheNearest) {
  Reading reading;
  reading.kind = "tape";
  reading.set("distance", 0.5);
  EXPECT_EQ(thrown([&] { reading.get<double>("distnce"); }),
            "a reading of kind 'tape' has no field 'distnce'; did you mean distance?");
  EXPECT_EQ(reading.get<double>("distnce", 7.0), 7.0);
  EXPECT_EQ(reading.get_if<double>("distnce"), nullptr);
}

TEST(Reading, AFieldOfAnotherTypeIsAnErrorAlsoWithADefault) {
  Reading reading;
  reading.kind = "tape";
  reading.set("distance", "far");
  const std::string problem =
      "the field 'distance' of kind 'tape' has the type text, and is read as number";
  EXPECT_EQ(thrown([&] { reading.get<double>("distance"); }), problem);
  EXPECT_EQ(thrown([&] { reading.get<double>("distance", 1.0); }), problem);
  EXPECT_EQ(reading.get_if<double>("distance"), nullptr);
  EXPECT_THROW(reading.get<std::int64_t>("distance"), Error);
}

TEST(Reading, AChoiceIsReadAsItsName) {
  Reading reading;
  reading.set("mode", Choice{1, "OPEN"});
  EXPECT_EQ(reading.get<std::string>("mode"), "OPEN");
  EXPECT_EQ(reading.get<Choice>("mode").value, 1);
}

}  // namespace
}  // namespace angen
