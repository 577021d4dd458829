#include "plugin/declared.h"

#include <gtest/gtest.h>

#include "core/diagnostics.h"

namespace angen {
namespace {

Kind tape() {
  return Kind("tape", "")
      .number("distance", "m", "")
      .integer("count", "", "")
      .flag("near", "")
      .text("name", "")
      .choice("mode", {"A", "B"}, "")
      .numbers("ranges", "m", "")
      .texts("ids", "")
      .image("image", "")
      .number("signal", "m", "")
      .with("model", "old")
      .text("signal", "")
      .with("model", "new");
}

template <class T>
std::string problem(const char* field, T value, const Kind& kind = tape()) {
  Reading reading;
  reading.set(field, std::move(value));
  try {
    check_fields(kind, reading);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Declared, FieldsOfTheirTypesPass) {
  Reading reading;
  reading.set("distance", 0.5);
  reading.set("count", 3);
  reading.set("near", true);
  reading.set("name", "hall");
  reading.set("mode", Choice{0, "A"});
  reading.set("ranges", std::vector<double>{1.0});
  reading.set("ids", std::vector<std::string>{"a"});
  reading.set("image", FloatImage{});
  const Reading before = reading;
  check_fields(tape(), reading);
  EXPECT_TRUE(reading.same_values(before));
}

TEST(Declared, AnUndeclaredNameIsAnErrorThatNamesTheNearest) {
  EXPECT_EQ(problem("distnce", 0.5)
                .find("kind 'tape' does not declare the field 'distnce'; did "
                      "you mean distance"),
            0U);
}

TEST(Declared, AnotherTypeIsAnError) {
  EXPECT_EQ(problem("distance", true),
            "the field 'distance' is set to a value of type flag; kind 'tape' declares it as "
            "number");
  EXPECT_NE(problem("count", 0.5), "");
  EXPECT_NE(problem("near", 1), "");
  EXPECT_NE(problem("name", 1), "");
  EXPECT_NE(problem("mode", "A"), "");
  EXPECT_NE(problem("ranges", 1.0), "");
  EXPECT_NE(problem("ids", std::vector<double>{1.0}), "");
  EXPECT_NE(problem("image", "a.png"), "");
}

TEST(Declared, AnIntegerBecomesTheNumberThatIsDeclared) {
  Reading reading;
  reading.set("distance", 2);
  reading.set("ids", std::vector<double>());
  check_fields(tape(), reading);
  ASSERT_NE(reading.get_if<double>("distance"), nullptr);
  EXPECT_EQ(reading.get<double>("distance"), 2.0);
  EXPECT_NE(reading.get_if<std::vector<std::string>>("ids"), nullptr);
}

TEST(Declared, AFieldMayBeDeclaredWithEachValueOfAParameter) {
  EXPECT_EQ(problem("signal", 0.5), "");
  EXPECT_EQ(problem("signal", "loud"), "");
  EXPECT_NE(problem("signal", true), "");
}

TEST(Declared, AKindThatDeclaresNoFieldsHasAny) {
  EXPECT_EQ(problem("anything", 0.5, Kind("toy", "")), "");
}

TEST(Declared, FieldsAreCheckedAgainOnlyWhereThereAreMore) {
  Reading reading;
  std::size_t checked = 0;
  reading.set("distance", 1);
  check_new_fields(tape(), reading, checked);
  EXPECT_EQ(checked, 1U);
  reading.set("distnce", 1.0);
  EXPECT_THROW(check_new_fields(tape(), reading, checked), Error);
}

TEST(Declared, NoiseIsOfNumbersThatAreDeclared) {
  const auto noise_of = [](const std::string& field) {
    Noise noise;
    noise.field = field;
    return std::vector<Noise>{noise};
  };
  check_noise(tape(), noise_of("distance"));
  check_noise(tape(), noise_of("ranges"));
  EXPECT_THROW(check_noise(tape(), noise_of("distnce")), Error);
  EXPECT_THROW(check_noise(tape(), noise_of("count")), Error);
}

}  // namespace
}  // namespace angen
