#include "devices/part_names.h"

#include <gtest/gtest.h>

namespace angen::devices {
namespace {

TEST(CommandName, DropsDigitsAndKindAndAddsTheFloor) {
  EXPECT_EQ(command_name("bathroom_door1", "door", 1), "bathroom1");
  EXPECT_EQ(command_name("kitchen_door", "door", 2), "kitchen2");
  EXPECT_EQ(command_name("door_kitchen_12", "door", 0), "kitchen0");
  EXPECT_EQ(command_name("kitchen_lamp", "lamp", 0), "kitchen0");
  EXPECT_EQ(command_name("kitchen_lamp", "door", 0), "kitchen_lamp0");
}

TEST(CommandName, OfADoorHasTheRoomInFull) {
  EXPECT_EQ(command_name("bath_door0", "door", 0), "bathroom0");
  EXPECT_EQ(command_name("bath_door1", "door", 1), "bathroom1");
  EXPECT_EQ(command_name("living_door0", "door", 0), "livingroom0");
  EXPECT_EQ(command_name("bed_door0", "door", 0), "bedroom0");
  EXPECT_EQ(command_name("work_door1", "door", 1), "workroom1");
  EXPECT_EQ(command_name("bed_lamp0", "lamp", 0), "bed0");
  EXPECT_EQ(command_name("sunbath_door", "door", 0), "sunbath0");
}

TEST(CommandName, NeverEndsUpEmpty) {
  EXPECT_EQ(command_name("door", "door", 0), "door0");
  EXPECT_EQ(command_name("123", "door", 0), "door0");
}

TEST(LeafName, IsTheRoomBeforeTheKindAndTheFloorThatItNames) {
  EXPECT_EQ(leaf_name("entrance_f1_door_block", "door", 0), "entrance1");
  EXPECT_EQ(leaf_name("entrance_f1_door_joint2", "door", 0), "entrance1");
  EXPECT_EQ(leaf_name("kitchen_door_block", "door", 1), "kitchen1");
  EXPECT_EQ(leaf_name("work_f12_room_door", "door", 0), "work_f12_room0");
  EXPECT_EQ(leaf_name("kitchen_doorstep", "door", 0), "");
  EXPECT_EQ(leaf_name("door_block", "door", 0), "");
  EXPECT_EQ(leaf_name("leaf", "door", 0), "");
}

}  // namespace
}  // namespace angen::devices
