#include "plugin/command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace angen {
namespace {

Kind lamp() {
  return Kind("lamp", "").verb("On", "").verb("Dim", "percent", "%", {0.0, 100.0}, "");
}

Kind elevator() { return Kind("elevator", "").counted_verb("Floor", "floor", {0.0, 99.0}, ""); }

Kind drive() { return Kind("drive", "").verb("Stop", "").value_units({"m/s", "rad/s"}); }

Command parsed(const Kind& kind, const std::string& text, std::vector<double> values = {}) {
  Command command{text, std::move(values), "", 0.0};
  EXPECT_EQ(parse_command(kind, command), "") << text;
  return command;
}

std::string rejection(const Kind& kind, const std::string& text, std::vector<double> values = {}) {
  Command command{text, std::move(values), "", 0.0};
  return parse_command(kind, command);
}

TEST(Command, FindsVerbAndNumberInAnyCase) {
  EXPECT_EQ(parsed(lamp(), "ON").verb, "On");
  const Command dim = parsed(lamp(), " dim,\t40 ");
  EXPECT_EQ(dim.verb, "Dim");
  EXPECT_EQ(dim.number, 40.0);
}

TEST(Command, AnIntegerMayFollowItsVerbWithoutABlank) {
  EXPECT_EQ(parsed(elevator(), "Floor12").number, 12.0);
  EXPECT_EQ(parsed(elevator(), "floor 3").number, 3.0);
  for (const char* text :
       {"Floor", "Floor1.5", "Floor-1", "Floor100", "Floor99999999999", "Flo1"}) {
    EXPECT_NE(rejection(elevator(), text), "") << text;
  }
}

TEST(Command, RejectionsSayWhatWouldBeRight) {
  const std::string right = "a lamp takes On, Dim <0 to 100 percent>";
  for (const char* text : {"", "Off", "On 1", "Dim", "Dim x", "Dim nan", "Dim 101", "Dim -1",
                           "Dim 1 2", "Dim 1e999"}) {
    EXPECT_NE(rejection(lamp(), text).find(right), std::string::npos) << rejection(lamp(), text);
  }
  EXPECT_NE(rejection(elevator(), "Up").find("an elevator takes Floor<0 to 99 floor>"),
            std::string::npos);
}

TEST(Command, NumbersAloneAreValuesOfAKindThatTakesThem) {
  EXPECT_EQ(parsed(drive(), "0.1 -0.2").values, (std::vector<double>{0.1, -0.2}));
  EXPECT_EQ(parsed(drive(), "", {0.3, 0.4}).values, (std::vector<double>{0.3, 0.4}));
  EXPECT_EQ(parsed(drive(), "stop").verb, "Stop");
  EXPECT_EQ(parsed(drive(), "stop").values, (std::vector<double>{0.0, 0.0}));
  EXPECT_NE(rejection(drive(), "0.1"), "");
  EXPECT_NE(rejection(drive(), "", {0.1, std::numeric_limits<double>::infinity()}), "");
  EXPECT_NE(rejection(lamp(), "", {0.1, 0.2}), "");
}

TEST(Command, AVerbMayTakeTwoNumbers) {
  const Kind person = Kind("person", "").verb("Stop", "").pair_verb("GoTo", "x y", "m", {}, "");
  const Command sent = parsed(person, "goto 1.5, -2");
  EXPECT_EQ(sent.verb, "GoTo");
  EXPECT_EQ(sent.values, (std::vector<double>{1.5, -2.0}));
  EXPECT_EQ(sent.number, 1.5);
  for (const char* text : {"GoTo", "GoTo 1", "GoTo 1 x", "GoTo 1 2 3", "GoTo nan 1"}) {
    EXPECT_NE(rejection(person, text).find("Stop, GoTo <x> <y>"), std::string::npos)
        << rejection(person, text);
  }
}

TEST(Command, AVerbMayTakeAPlace) {
  const Kind person = Kind("person", "").place_verb("GoTo", "");
  EXPECT_EQ(parsed(person, "goto 1.5, -2").values, (std::vector<double>{1.5, -2.0}));
  EXPECT_EQ(parsed(person, "GoTo 1 2 -1").values, (std::vector<double>{1.0, 2.0, -1.0}));
  EXPECT_EQ(parsed(person, "GoTo Living Room").place, "Living Room");
  EXPECT_EQ(parsed(person, " GoTo, 'kitchen0' ").place, "kitchen0");
  for (const char* text : {"GoTo", "GoTo 1", "GoTo 1 x", "GoTo 1 2 3 4", "GoTo nan 1"}) {
    EXPECT_NE(rejection(person, text).find("GoTo <x> <y> [<floor>] or <name of a room or thing>"),
              std::string::npos)
        << rejection(person, text);
  }
}

TEST(Command, AKindWithoutVerbsTakesAnyText) {
  EXPECT_EQ(parsed(Kind("toy", ""), "dance 3").text, "dance 3");
  EXPECT_TRUE(parsed(Kind("toy", ""), "dance 3").values.empty());
  EXPECT_EQ(parsed(Kind("toy", ""), "0.2, -1").values, (std::vector<double>{0.2, -1.0}));
}

}  // namespace
}  // namespace angen
