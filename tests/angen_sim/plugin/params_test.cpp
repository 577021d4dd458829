#include "plugin/params.h"

#include <gtest/gtest.h>

#include <clocale>

#include "angen_sim/fakes.h"

namespace angen {
namespace {

using test::element;
using test::plugin_element;

/// The one line that `act` complains with, "" when it does not.
template <class F>
std::string complaint(F&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string complaint_about_number(const std::string& text, Range range = {}) {
  Params params(plugin_element({{"x", text}}));
  return complaint([&] { params.number("x", 0.0, "m", "", range); });
}

TEST(Params, GivesTheFallbackForWhatIsNotThere) {
  Params params(plugin_element({}));
  EXPECT_EQ(params.number("x", 1.5, "m", ""), 1.5);
  EXPECT_EQ(params.integer("n", 3, "", ""), 3);
  EXPECT_TRUE(params.flag("f", true, ""));
  EXPECT_EQ(params.text("t", "abc", ""), "abc");
  EXPECT_EQ(params.choice("c", "b", {"a", "b"}, ""), "b");
  EXPECT_TRUE(params.rows("r", 3, "", "").empty());
}

TEST(Params, ReadsWholeNumbersInAnyNotation) {
  Params params(plugin_element({{"a", "-1.57"}, {"b", "1e-3"}, {"c", "+2"}, {"n", "-7"}}));
  EXPECT_EQ(params.number("a", 0.0, "", ""), -1.57);
  EXPECT_EQ(params.number("b", 0.0, "", ""), 1e-3);
  EXPECT_EQ(params.number("c", 0.0, "", ""), 2.0);
  EXPECT_EQ(params.integer("n", 0, "", ""), -7);
}

TEST(Params, RejectsWhatIsNotOneFiniteNumber) {
  for (const char* text : {"", "abc", "1.0x", "1 2", "1,5", "nan", "inf", "1e999", "0x10", "+-1"}) {
    EXPECT_EQ(complaint_about_number(text),
              "test.sdf:1: <x> is \"" + std::string(text) + "\", must be a finite number (m)");
  }
}

TEST(Params, SaysTheRange) {
  EXPECT_EQ(complaint_about_number("0", kPositive), "test.sdf:1: <x> is 0 m, must be > 0");
  EXPECT_EQ(complaint_about_number("-1", kNotNegative), "test.sdf:1: <x> is -1 m, must be >= 0");
  EXPECT_EQ(complaint_about_number("9", {1.0, 2.5}),
            "test.sdf:1: <x> is 9 m, must be >= 1 and <= 2.5");
  EXPECT_EQ(complaint_about_number("0", kNotNegative), "");
}

TEST(Params, OfARobotMadeForGazeboTakesTheWholePart) {
  Params params(plugin_element({{"n", "666.51"}, {"m", "1e12"}, {"w", "many"}}));
  params.take_first();
  EXPECT_EQ(params.integer("n", 0, "", ""), 666);
  ASSERT_EQ(params.warnings().size(), 1U);
  EXPECT_NE(params.warnings()[0].text().find("a whole number; 666 is taken"), std::string::npos);
  for (const char* path : {"m", "w"}) {
    EXPECT_NE(complaint([&] { params.integer(path, 0, "", ""); }).find("must be a whole number"),
              std::string::npos);
  }
}

TEST(Params, RejectsFractionsWordsAndUnknownChoices) {
  Params params(plugin_element({{"n", "1.5"}, {"f", "yes"}, {"c", "z"}}));
  EXPECT_EQ(complaint([&] { params.integer("n", 0, "", ""); }),
            "test.sdf:1: <n> is \"1.5\", must be a whole number");
  EXPECT_EQ(complaint([&] { params.flag("f", false, ""); }),
            "test.sdf:1: <f> is \"yes\", must be true or false");
  EXPECT_EQ(complaint([&] {
              params.choice("c", "a", {"a", "b"}, "");
            }),
            "test.sdf:1: <c> is \"z\", must be one of a, b");
}

TEST(Params, LooksInThePluginFirstThenInTheSensor) {
  const Element range = element("range", "", {element("max", "6")});
  const Element sensor = element("sensor", "", {element("ray", "", {range}), element("a", "1")});
  Params params(plugin_element({{"a", "2"}}), &sensor);
  EXPECT_EQ(params.number("ray/range/max", 0.0, "m", ""), 6.0);
  EXPECT_EQ(params.number("a", 0.0, "", ""), 2.0);
}

TEST(Params, AnUnknownKeyIsNamedWithItsPlaceAndTheKnownOnes) {
  Element plugin = plugin_element({{"threshold", "0.1"}});
  plugin.attributes = {{"filename", "libpir_controller.so"}};
  plugin.children.push_back(element("thresold", "0.2"));
  plugin.children.back().source = {"a.world", 12};
  Params params(plugin);
  params.number("threshold", 0.0, "m", "");
  params.number("nod_period", 0.0, "s", "");
  EXPECT_EQ(
      complaint([&] { params.finish(); }),
      "a.world:12: <thresold> is not a parameter of libpir_controller.so; known are threshold, "
      "nod_period");
}

TEST(Params, AnUnknownKeyInsideAKnownOneIsFound) {
  Params params(plugin_element({}));
  Element plugin =
      element("plugin", "", {element("pid", "", {element("p", "1"), element("q", "2")})});
  Params nested(plugin);
  nested.number("pid/p", 0.0, "", "");
  EXPECT_NE(complaint([&] { nested.finish(); }).find("<pid/q> is not a parameter"),
            std::string::npos);
}

TEST(Params, WhatEveryGazeboPluginMayCarryIsKnown) {
  Params params(plugin_element({{"alwaysOn", "true"},
                                {"topicName", "/t"},
                                {"frameName", "f"},
                                {"updateRate", "1"},
                                {"robotNamespace", "/"}}));
  EXPECT_EQ(complaint([&] { params.finish(); }), "");
}

TEST(Params, AKeyGivenTwiceIsRejected) {
  Params params(plugin_element({{"x", "1"}, {"x", "2"}}));
  EXPECT_EQ(complaint([&] { params.number("x", 0.0, "", ""); }),
            "test.sdf:1: <x> is given twice, one is enough");
}

TEST(Params, RowsAreReadInOrderAndMustBeWhole) {
  Params params(plugin_element({{"waypoint", "0 1 2"}, {"waypoint", " 3\t4\n5 "}}));
  const std::vector<std::vector<double>> expected = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(params.rows("waypoint", 3, "m", ""), expected);
  EXPECT_EQ(complaint([&] { params.rows("waypoint", 4, "m", ""); }),
            "test.sdf:1: <waypoint> has 3 numbers, must have 4 (m)");
}

TEST(Params, ARowIsGivenOnceOrIsTheFallback) {
  Params params(plugin_element({{"position", "0 1 2"}, {"magnet", "1"}, {"magnet", "2"}}));
  EXPECT_EQ(params.row("position", {7, 7, 7}, "m", ""), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(params.row("place", {0.5, 0}, "m", ""), (std::vector<double>{0.5, 0}));
  EXPECT_EQ(params.docs().back().fallback, "0.5 0");
  EXPECT_EQ(complaint([&] {
              params.row("position", {0, 0}, "m", "");
            }),
            "test.sdf:1: <position> has 3 numbers, must have 2 (m)");
  EXPECT_EQ(complaint([&] { params.row("magnet", {0}, "m", ""); }),
            "test.sdf:1: <magnet> is given twice, one is enough");
}

TEST(Params, TheUpdateRateBecomesAPeriod) {
  const Element sensor = element("sensor", "", {element("update_rate", "20")});
  EXPECT_EQ(Params(plugin_element({}), &sensor).update_period(), 50'000'000);
  EXPECT_EQ(Params(plugin_element({{"updateRate", "4"}}), &sensor).update_period(), 250'000'000);
  EXPECT_EQ(Params(plugin_element({{"update_rate", "0"}}), nullptr, 5.0).update_period(),
            200'000'000);
  EXPECT_EQ(Params(plugin_element({}), nullptr, 5.0).update_period(), 200'000'000);
}

TEST(Params, AnUpdateRateWithoutAPeriodInNanosecondsIsRejected) {
  Params params(plugin_element({{"update_rate", "1e-300"}}));
  EXPECT_EQ(complaint([&] { params.update_period(); }),
            "test.sdf:1: <update_rate> is 1e-300 Hz, must be 0 or >= 1e-06");
}

TEST(Params, NumbersDoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // where it is not installed nothing changes
  EXPECT_EQ(Params(plugin_element({{"x", "1.5"}})).number("x", 0.0, "", ""), 1.5);
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(Params, DocumentsWhatWasReadOnce) {
  Params params(plugin_element({}));
  params.number("x", 0.1, "m", "how far");
  params.number("x", 0.1, "m", "how far");
  ASSERT_EQ(params.docs().size(), 1U);
  EXPECT_EQ(params.docs()[0].path, "x");
  EXPECT_EQ(params.docs()[0].fallback, "0.1");
  EXPECT_EQ(params.docs()[0].unit, "m");
}

TEST(Device, RejectsCommandsUnlessItTakesSome) {
  struct Mute : Device {
    void configure(Params&, Wiring&) override {}
    void update(const View&, Outputs&) override {}
    void report(const View&, Reading&) const override {}
  } mute;
  const test::FakeWorld world;
  const Verdict verdict = mute.command({"Open", {}, "", 0.0}, world);
  EXPECT_FALSE(verdict.accepted);
  EXPECT_EQ(verdict.reason, "it takes no commands");
}

TEST(ModelInfo, FindsAJointByName) {
  ModelInfo info;
  info.joints = {{"hinge", "revolute", "base", "leaf"}};
  ASSERT_NE(info.joint("hinge"), nullptr);
  EXPECT_EQ(info.joint("hinge")->child, "leaf");
  EXPECT_EQ(info.joint("other"), nullptr);
}

}  // namespace
}  // namespace angen
