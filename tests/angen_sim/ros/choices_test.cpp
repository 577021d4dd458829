// The words of a kind's modes are in the order of its message's constants.
#include <angen_msgs/DoorState.h>
#include <angen_msgs/ElevatorState.h>
#include <angen_msgs/PersonState.h>
#include <gtest/gtest.h>

#include "plugin/library.h"

namespace angen::node {
namespace {

std::vector<std::string> words_of(const std::string& kind, const std::string& field) {
  Catalog catalog;
  for (const auto& plugin : catalog.own()) {
    if (plugin->kind().name != kind) continue;
    for (const Field& each : plugin->kind().fields) {
      if (each.name == field) return each.words;
    }
  }
  return {};
}

TEST(Choices, OfAPerson) {
  using State = angen_msgs::PersonState;
  const std::vector<std::string> words = words_of("person", "mode");
  ASSERT_EQ(words.size(), 5U);
  EXPECT_EQ(words[State::STANDING], "STANDING");
  EXPECT_EQ(words[State::WALKING], "WALKING");
  EXPECT_EQ(words[State::BLOCKED], "BLOCKED");
  EXPECT_EQ(words[State::SITTING], "SITTING");
  EXPECT_EQ(words[State::LYING], "LYING");
}

TEST(Choices, OfDoorsWindowsAndCabinets) {
  using State = angen_msgs::DoorState;
  for (const char* kind : {"door", "window", "cabinet"}) {
    const std::vector<std::string> words = words_of(kind, "mode");
    ASSERT_EQ(words.size(), 6U) << kind;
    EXPECT_EQ(words[State::CLOSED], "CLOSED");
    EXPECT_EQ(words[State::OPEN], "OPEN");
    EXPECT_EQ(words[State::OPENING], "OPENING");
    EXPECT_EQ(words[State::CLOSING], "CLOSING");
    EXPECT_EQ(words[State::BLOCKED], "BLOCKED");
    EXPECT_EQ(words[State::AJAR], "AJAR");
  }
}

TEST(Choices, OfAnElevatorAndItsDoors) {
  using State = angen_msgs::ElevatorState;
  const std::vector<std::string> cabin = words_of("elevator", "mode");
  ASSERT_EQ(cabin.size(), 5U);
  EXPECT_EQ(cabin[State::OVERLOADED], "OVERLOADED");
  EXPECT_EQ(cabin[State::IDLE], "IDLE");
  EXPECT_EQ(cabin[State::UP], "UP");
  EXPECT_EQ(cabin[State::DOWN], "DOWN");
  EXPECT_EQ(cabin[State::BLOCKED], "BLOCKED");
  const std::vector<std::string> doors = words_of("elevator", "door_mode");
  ASSERT_EQ(doors.size(), 5U);
  EXPECT_EQ(doors[State::DOOR_CLOSED], "CLOSED");
  EXPECT_EQ(doors[State::DOOR_OPEN], "OPEN");
  EXPECT_EQ(doors[State::DOOR_OPENING], "OPENING");
  EXPECT_EQ(doors[State::DOOR_CLOSING], "CLOSING");
  EXPECT_EQ(doors[State::DOOR_BLOCKED], "BLOCKED");
}

}  // namespace
}  // namespace angen::node
