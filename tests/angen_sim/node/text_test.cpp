#include "node/text.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace angen::node {
namespace {

std::string sent(const sim::Action& action) {
  const auto& command = std::get<sim::ToDevice>(action);
  return command.kind + "/" + command.name + ": " + command.command.text;
}

std::string rejection(const sim::Action& action) { return std::get<sim::Reject>(action).reason; }

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Kind door(const std::string& name = "door") {
  return Kind(name, "")
      .command_topic("/gazebo/Door_controller")
      .verb("Open", "")
      .verb("Close", "")
      .verb("Set", "radians", "rad", {}, "");
}

Kind elevator() {
  return Kind("elevator", "")
      .command_topic("/gazebo/Elevator_controller")
      .counted_verb("Floor", "floor", {0.0, 999.0}, "");
}

TEST(Text, CurlyQuotesAreLeftOut) {
  EXPECT_EQ(sent(topic_action(door(), "\u201DOpen, \u201Cbathroom1\u201D\u201D")),
            "door/bathroom1: Open");
  EXPECT_EQ(sent(any_action("\u201Cturtlebot\u201D", "0.1 -0.2")), "/turtlebot: 0.1 -0.2");
}

TEST(ListedText, TargetsAndTextsInOrder) {
  const std::vector<sim::Action> actions =
      listed_actions(" lamp/all On;door/kitchen0  Set -1.2 ; ;");
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(sent(actions[0]), "/lamp/all: On");
  EXPECT_EQ(sent(actions[1]), "/door/kitchen0: Set -1.2");
  EXPECT_TRUE(listed_actions("").empty());
  EXPECT_TRUE(says(rejection(listed_actions("kitchen0").at(0)), "no text"));
}

TEST(DoorText, IsAVerbANameAndANumber) {
  for (const auto& [text, command] : std::vector<std::pair<std::string, std::string>>{
           {"Open, bathroom1", "door/bathroom1: Open"},
           {"Close, all", "door/all: Close"},
           {"Set, kitchen0, -1.2", "door/kitchen0: Set -1.2"},
           {"  oPEN ,\tbathroom1 \n", "door/bathroom1: oPEN"},
           {"SET,kitchen0,+1e-1", "door/kitchen0: SET +1e-1"},
           {"Open, Bathroom1", "door/Bathroom1: Open"},
           {"Opn, a", "door/a: Opn"},  // the queue parses verb and number
           {"Set, a, 1, fast", "door/a: Set 1 fast"}}) {
    EXPECT_EQ(sent(topic_action(door(), text)), command);
  }
  EXPECT_EQ(sent(topic_action(door("window"), "Open, hall0")), "window/hall0: Open");
}

TEST(DoorText, ANameBeforeItsVerbIsAnsweredByTheRightOrder) {
  EXPECT_TRUE(
      says(rejection(topic_action(door(), "bathroom1, open")), "did you mean `open, bathroom1`?"));
  EXPECT_TRUE(
      says(rejection(topic_action(elevator(), "tower, Floor1")), "did you mean `Floor1, tower`?"));
  EXPECT_EQ(sent(topic_action(door(), "Open, Close")), "door/Close: Open");  // a door's name
  EXPECT_EQ(sent(topic_action(elevator(), "tower, Floors")), "elevator/Floors: tower");
}

TEST(LongText, IsRejectedWithItsLength) {
  const std::string longest(1'000'000, 'x');
  for (const sim::Action& action :
       {topic_action(door(), longest), topic_action(door(), "Open, " + longest),
        any_action(longest, "Open"), any_action("a", longest)}) {
    EXPECT_TRUE(says(rejection(action), "at most 4096")) << rejection(action);
    EXPECT_TRUE(says(rejection(action), "(10000")) << rejection(action);
    EXPECT_LT(rejection(action).size(), 400U);
  }
}

TEST(DoorText, AMissingVerbOrNameIsRejectedWithTheRightForms) {
  for (const std::string text : {"", ",", ", a", "Open", "Open,"}) {
    const std::string reason = rejection(topic_action(door(), text));
    EXPECT_TRUE(says(reason, "Set <radians>")) << text << " -> " << reason;
    EXPECT_TRUE(says(reason, "`" + text + "`")) << reason;
  }
}

TEST(DoorText, OtherBytesThanUtf8AreRejectedInPrintableWords) {
  const std::string reason = rejection(topic_action(door(), "Open, \xff\xfe"));
  EXPECT_TRUE(says(reason, "not UTF-8")) << reason;
  EXPECT_TRUE(valid_utf8(reason));
}

TEST(ElevatorText, NeedsNoName) {
  EXPECT_EQ(sent(topic_action(elevator(), " floor 0 ")), "elevator/: floor 0");
  EXPECT_EQ(sent(topic_action(elevator(), "Floor2, b")), "elevator/b: Floor2");
  EXPECT_TRUE(says(rejection(topic_action(elevator(), "Floor1,")), "no name"));
  EXPECT_TRUE(says(rejection(topic_action(elevator(), "")), "Floor<0 to 999 floor>"));
}

TEST(AnyText, ReachesADeviceByName) {
  EXPECT_EQ(sent(any_action(" lamp/kitchen0 ", " Dim 40 ")), "/lamp/kitchen0: Dim 40");
  EXPECT_TRUE(says(rejection(any_action("", "On")), "no target"));
  EXPECT_TRUE(says(rejection(any_action("kitchen0", " ")), "no text"));
}

}  // namespace
}  // namespace angen::node
