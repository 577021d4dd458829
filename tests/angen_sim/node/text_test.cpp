#include "node/text.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

std::string sent(const sim::Action& action) {
  const auto& command = std::get<sim::ToDevice>(action);
  return command.kind + "/" + command.name + ": " + command.command.text;
}

std::string refused(const sim::Action& action) { return std::get<sim::Reject>(action).reason; }

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Kind door(const std::string& name = "door") {
  return Kind(name, "")
      .commanded_on("/gazebo/Door_controller")
      .verb("Open", "")
      .verb("Close", "")
      .verb("Set", "radians", "rad", {}, "");
}

Kind lamp() {
  return Kind("lamp", "")
      .commanded_on("/gazebo/Light_controller")
      .verb("On", "")
      .verb("Off", "")
      .verb("Dim", "percent", "%", {0.0, 100.0}, "");
}

Kind elevator() {
  return Kind("elevator", "")
      .commanded_on("/gazebo/Elevator_controller")
      .counted_verb("Floor", "floor", {0.0, 999.0}, "");
}

const std::vector<std::string> kTwo{"a", "b"};

TEST(TopicText, CurlyQuotesAreLeftOut) {
  EXPECT_EQ(sent(topic_action(door(), "\u201DOpen, bathroom1\u201D", {})), "door/bathroom1: Open");
  EXPECT_EQ(sent(topic_action(door(), "Open, \u201Cbathroom1\u201D", {})), "door/bathroom1: Open");
  EXPECT_EQ(sent(topic_action(elevator(), "\u201CFloor1\u201D", {"lift"})),
            "elevator/lift: Floor1");
  EXPECT_EQ(
      std::get<sim::ToDevice>(topic_action(door(), "Set, hall0, \u22121.2", {})).command.number,
      -1.2);
}

TEST(AnyText, CurlyQuotesAndMinusSignsAreReadAsMeant) {
  const sim::Action action = any_action("\u201Cturtlebot\u201D", "\u201C0.1 \u22120.2\u201D");
  const auto& command = std::get<sim::ToDevice>(action);
  EXPECT_EQ(command.name, "turtlebot");
  EXPECT_EQ(command.command.values, (std::vector<double>{0.1, -0.2}));
  EXPECT_TRUE(says(refused(any_action("a", "\u201C\u201D")), "no text"));
}

TEST(DoorText, VerbsAndNames) {
  EXPECT_EQ(sent(topic_action(door(), "Open, bathroom1", kTwo)), "door/bathroom1: Open");
  EXPECT_EQ(sent(topic_action(door(), "Close, all", kTwo)), "door/all: Close");
  EXPECT_EQ(sent(topic_action(door("window"), "Open, hall0", kTwo)), "window/hall0: Open");
  EXPECT_EQ(sent(topic_action(door(), "Set, kitchen0, -1.2", kTwo)), "door/kitchen0: Set -1.2");
}

TEST(DoorText, CaseOfVerbsAndBlanksDoNotMatter) {
  const sim::Action open = topic_action(door(), "  oPEN ,\tbathroom1 \n", kTwo);
  EXPECT_EQ(std::get<sim::ToDevice>(open).command.verb, "Open");
  const sim::Action set = topic_action(door(), "SET,kitchen0,+1e-1", kTwo);
  EXPECT_EQ(std::get<sim::ToDevice>(set).command.verb, "Set");
  EXPECT_EQ(std::get<sim::ToDevice>(set).command.number, 0.1);
}

TEST(LongText, IsRefusedWithItsLength) {
  const std::string longest(1'000'000, 'x');
  for (const sim::Action& action :
       {topic_action(door(), longest, kTwo), topic_action(door(), "Open, " + longest, kTwo),
        any_action(longest, "Open"), any_action("a", longest)}) {
    EXPECT_TRUE(says(refused(action), "at most 4096")) << refused(action);
    EXPECT_TRUE(says(refused(action), "(10000")) << refused(action);
    EXPECT_LT(refused(action).size(), 400U);
  }
}

TEST(DoorText, CaseOfNamesMatters) {
  EXPECT_EQ(sent(topic_action(door(), "Open, Bathroom1", kTwo)), "door/Bathroom1: Open");
}

TEST(DoorText, MalformedIsRefusedWithTheRightForms) {
  for (const std::string text :
       {"", ",", "Open", "Open,", "Open, a, b", "Set, a", "Set, a, fast", "Set, a, nan",
        "Set, a, inf", "Set, a, 1, 2", "Opn, a", "Set, a, 1x", "Set, a, 0x1"}) {
    const std::string reason = refused(topic_action(door(), text, kTwo));
    EXPECT_TRUE(says(reason, "Set <radians>")) << text << " -> " << reason;
    EXPECT_TRUE(says(reason, "`" + text + "`")) << reason;
  }
}

TEST(DoorText, OtherBytesThanUtf8AreRefusedInPrintableWords) {
  const std::string reason = refused(topic_action(door(), "Open, \xff\xfe", kTwo));
  EXPECT_TRUE(says(reason, "not UTF-8")) << reason;
  EXPECT_TRUE(valid_utf8(reason));
}

TEST(DoorText, ALongTextMakesAShortReason) {
  EXPECT_LT(refused(topic_action(door(), std::string(100000, 'x'), kTwo)).size(), 700U);
}

TEST(LampText, VerbsAndNames) {
  EXPECT_EQ(sent(topic_action(lamp(), "On, kitchen0", kTwo)), "lamp/kitchen0: On");
  EXPECT_EQ(sent(topic_action(lamp(), "off, all", kTwo)), "lamp/all: off");
  EXPECT_EQ(sent(topic_action(lamp(), "Dim, kitchen0, 40", kTwo)), "lamp/kitchen0: Dim 40");
  EXPECT_TRUE(says(refused(topic_action(lamp(), "Dim, kitchen0", kTwo)), "without percent"));
  EXPECT_TRUE(says(refused(topic_action(lamp(), "Dim, kitchen0, 101", kTwo)), "out of range"));
}

TEST(ElevatorText, TheOnlyElevatorNeedsNoName) {
  EXPECT_EQ(sent(topic_action(elevator(), "Floor1", {"lift"})), "elevator/lift: Floor1");
  const sim::Action spaced = topic_action(elevator(), " floor 0 ", {"lift"});
  EXPECT_EQ(std::get<sim::ToDevice>(spaced).command.number, 0.0);
}

TEST(ElevatorText, OneOfSeveralIsNamed) {
  EXPECT_EQ(sent(topic_action(elevator(), "Floor2, b", kTwo)), "elevator/b: Floor2");
  EXPECT_TRUE(says(refused(topic_action(elevator(), "Floor2", kTwo)), "no name"));
}

TEST(ElevatorText, MalformedIsRefused) {
  for (const std::string text : {"", "Floor", "FloorX", "Floor-1", "Floor1.5", "Floor1,", "Up",
                                 "Floor99999999999999999999", "Floor1, a, b"}) {
    const std::string reason = refused(topic_action(elevator(), text, {"lift"}));
    EXPECT_TRUE(says(reason, "Floor<0 to 999 floor>")) << text << " -> " << reason;
  }
  EXPECT_TRUE(says(refused(topic_action(elevator(), "Floor1", {})), "no elevator"));
}

TEST(AnyText, ReachesADeviceByName) {
  EXPECT_EQ(sent(any_action(" lamp/kitchen0 ", " Dim 40 ")), "/lamp/kitchen0: Dim 40");
  EXPECT_TRUE(says(refused(any_action("", "On")), "no target"));
  EXPECT_TRUE(says(refused(any_action("kitchen0", " ")), "no text"));
}

TEST(AnyText, NumbersAloneAreValues) {
  const auto values = [](const std::string& text) {
    return std::get<sim::ToDevice>(any_action("turtlebot", text)).command.values;
  };
  EXPECT_EQ(values("0.2, -1"), (std::vector<double>{0.2, -1.0}));
  EXPECT_TRUE(values("Dim 40").empty());
}

}  // namespace
}  // namespace angen::node
