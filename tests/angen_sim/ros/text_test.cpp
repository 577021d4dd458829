#include "ros/text.h"

#include <gtest/gtest.h>

namespace angen::node {
namespace {

std::string sent(const sim::Action& action) {
  const auto& order = std::get<sim::ToDevice>(action);
  return order.kind + "/" + order.name + ": " + order.command.text;
}

std::string refused(const sim::Action& action) { return std::get<sim::Reject>(action).reason; }

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(DoorText, VerbsAndNames) {
  EXPECT_EQ(sent(door_action("Open, bathroom1")), "door/bathroom1: Open");
  EXPECT_EQ(sent(door_action("Close, all")), "door/all: Close");
  EXPECT_EQ(sent(door_action("Open, hall0", "window", "Window_controller")), "window/hall0: Open");
  EXPECT_EQ(sent(door_action("Set, kitchen0, -1.2")), "door/kitchen0: Set -1.2");
}

TEST(DoorText, CaseOfVerbsAndBlanksDoNotMatter) {
  EXPECT_EQ(sent(door_action("  oPEN ,\tbathroom1 \n")), "door/bathroom1: Open");
  EXPECT_EQ(sent(door_action("SET,kitchen0,+1e-1")), "door/kitchen0: Set +1e-1");
}

TEST(DoorText, CaseOfNamesMatters) {
  EXPECT_EQ(sent(door_action("Open, Bathroom1")), "door/Bathroom1: Open");
}

TEST(DoorText, MalformedIsRefusedWithTheRightForms) {
  for (const std::string text :
       {"", ",", "Open", "Open,", "Open, a, b", "Set, a", "Set, a, fast", "Set, a, nan",
        "Set, a, inf", "Set, a, 1, 2", "Opn, a", "Open bathroom1", "Set, a, 1x", "Set, a, 0x1"}) {
    const std::string reason = refused(door_action(text));
    EXPECT_TRUE(says(reason, "`Set, NAME, RADIANS`")) << text << " -> " << reason;
    EXPECT_TRUE(says(reason, "`" + text + "`")) << reason;
  }
}

TEST(DoorText, OtherBytesThanUtf8AreRefusedInPrintableWords) {
  const std::string reason = refused(door_action("Open, \xff\xfe"));
  EXPECT_TRUE(says(reason, "not UTF-8")) << reason;
  EXPECT_TRUE(valid_utf8(reason));
}

TEST(DoorText, ALongTextMakesAShortReason) {
  EXPECT_LT(refused(door_action(std::string(100000, 'x'))).size(), 400U);
}

TEST(LampText, VerbsAndNames) {
  EXPECT_EQ(sent(lamp_action("On, kitchen0")), "lamp/kitchen0: On");
  EXPECT_EQ(sent(lamp_action("off, all")), "lamp/all: Off");
  EXPECT_EQ(sent(lamp_action("Dim, kitchen0, 40")), "lamp/kitchen0: Dim 40");
  EXPECT_TRUE(says(refused(lamp_action("Dim, kitchen0")), "no percent"));
}

TEST(ElevatorText, TheOnlyElevatorNeedsNoName) {
  EXPECT_EQ(sent(elevator_action("Floor1", {"lift"})), "elevator/lift: Floor1");
  EXPECT_EQ(sent(elevator_action(" floor 0 ", {"lift"})), "elevator/lift: Floor0");
}

TEST(ElevatorText, OneOfSeveralIsNamed) {
  EXPECT_EQ(sent(elevator_action("Floor2, b", {"a", "b"})), "elevator/b: Floor2");
  EXPECT_TRUE(says(refused(elevator_action("Floor2", {"a", "b"})), "which elevator of a, b"));
}

TEST(ElevatorText, MalformedIsRefused) {
  for (const std::string text : {"", "Floor", "FloorX", "Floor-1", "Floor1.5", "Floor1,", "Up",
                                 "Floor99999999999999999999", "Floor1, a, b"}) {
    EXPECT_TRUE(says(refused(elevator_action(text, {"lift"})), "`Floor0`, `Floor1`")) << text;
  }
  EXPECT_TRUE(says(refused(elevator_action("Floor1", {})), "no elevator"));
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
