// Every kind's message: the registrations in ros/kinds.
#include "angen_sim/ros/messages.h"

#include <angen_msgs/DoorState.h>
#include <angen_msgs/ElevatorState.h>
#include <angen_msgs/LampState.h>
#include <angen_msgs/PersonState.h>
#include <angen_msgs/PirMsg.h>
#include <angen_msgs/Reading.h>
#include <angen_msgs/RfidMsg.h>
#include <angen_msgs/RssiMsg.h>
#include <angen_msgs/SwitchMsg.h>
#include <gazebo_msgs/ContactsState.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/RelativeHumidity.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace angen::node {
namespace {

using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

TEST(Messages, KnownKindsHaveTheirOwnOthersTheGenericOne) {
  EXPECT_EQ(format_of("pir").type, "angen_msgs/PirMsg");
  EXPECT_EQ(format_of("contact").type, "gazebo_msgs/ContactsState");
  EXPECT_EQ(format_of("proximity").type, "sensor_msgs/Range");
  EXPECT_EQ(format_of("window").type, "angen_msgs/DoorState");
  EXPECT_EQ(format_of("smoke").type, "angen_msgs/Reading");
}

TEST(Messages, Pir) {
  Reading reading;
  reading.set("motion", true);
  reading.set("departure", true);
  reading.set("difference", 0.4);
  reading.set("threshold", 0.1);
  reading.set("signal", 4.0);
  reading.set("signal_threshold", 1.0);
  angen_msgs::PirMsg message;
  fill("pir", reading, {}, message);
  EXPECT_TRUE(message.motion);
  EXPECT_TRUE(message.departure);
  EXPECT_EQ(message.difference, 0.4);
  EXPECT_EQ(message.threshold, 0.1);
  EXPECT_EQ(message.signal, 4.0);
  EXPECT_EQ(message.signal_threshold, 1.0);
}

TEST(Messages, FieldsThatAReadingMayLackStayAsTheyAre) {
  Reading heat;
  heat.set("motion", true);
  heat.set("signal", 4.0);
  heat.set("signal_threshold", 1.0);
  angen_msgs::PirMsg detected;
  detected.threshold = 0.7;
  fill("pir", heat, {}, detected);
  EXPECT_TRUE(detected.motion);
  EXPECT_FALSE(detected.departure);
  EXPECT_EQ(detected.difference, 0.0);
  EXPECT_EQ(detected.threshold, 0.7);
  EXPECT_EQ(detected.signal, 4.0);
  Reading bulb;
  bulb.set("on", true);
  bulb.set("level", 40.0);
  bulb.set("luminous_flux", 800.0);
  angen_msgs::LampState lamp;
  fill("lamp", bulb, {"kitchen0", "world"}, lamp);
  EXPECT_EQ(lamp.name, "kitchen0");
  EXPECT_EQ(lamp.luminous_flux, 800.0);
  EXPECT_EQ(lamp.illuminance, 0.0);
}

TEST(Messages, SwitchTakesTwoRanges) {
  Reading reading;
  reading.set("closed", true);
  reading.set("changed", false);
  reading.set("ranges", Numbers{0.2, 0.3});
  reading.set("difference", 0.1);
  reading.set("threshold", 0.05);
  angen_msgs::SwitchMsg message;
  fill("switch", reading, {}, message);
  EXPECT_TRUE(message.closed);
  EXPECT_EQ(message.ranges[0], 0.2);
  EXPECT_EQ(message.ranges[1], 0.3);
}

TEST(Messages, RangeIsTheMaximumWhereNothingIsNear) {
  Reading reading;
  reading.set("range", std::numeric_limits<double>::infinity());
  reading.set("min_range", 0.02);
  reading.set("max_range", 4.0);
  reading.set("field_of_view", 0.26);
  reading.set("infrared", true);
  sensor_msgs::Range message;
  fill("proximity", reading, {}, message);
  EXPECT_FLOAT_EQ(message.range, 4.0F);
  EXPECT_EQ(message.radiation_type, sensor_msgs::Range::INFRARED);
  EXPECT_FLOAT_EQ(message.max_range, 4.0F);
  EXPECT_FLOAT_EQ(message.field_of_view, 0.26F);
}

TEST(Messages, RfidAndRssiListIdsAndNumbers) {
  Reading reading;
  reading.set("ids", Texts{"a", "b"});
  reading.set("distances", Numbers{0.5, 1.5});
  reading.set("rssi", Numbers{-40.5, -71.0});
  angen_msgs::RfidMsg tags;
  fill("rfid", reading, {}, tags);
  EXPECT_EQ(tags.ids, (Texts{"a", "b"}));
  EXPECT_EQ(tags.distances, (Numbers{0.5, 1.5}));
  angen_msgs::RssiMsg senders;
  fill("receiver", reading, {}, senders);
  EXPECT_EQ(senders.ids, (Texts{"a", "b"}));
  EXPECT_EQ(senders.rssi, (Numbers{-40.5, -71.0}));
}

TEST(Messages, HumidityIsAFraction) {
  Reading reading;
  reading.set("humidity", 45.0);
  reading.set("variance", 4.0);
  sensor_msgs::RelativeHumidity message;
  fill("humidity", reading, {}, message);
  EXPECT_DOUBLE_EQ(message.relative_humidity, 0.45);
  EXPECT_DOUBLE_EQ(message.variance, 4e-4);
}

TEST(Messages, ABatteryDrawsANegativeCurrent) {
  Reading state;
  state.set("voltage", 14.8);
  state.set("drawn", 29.6);
  state.set("charge", 1.0);
  state.set("capacity", 4.0);
  state.set("percentage", 0.25);
  sensor_msgs::BatteryState message;
  fill("battery", state, {}, message);
  EXPECT_FLOAT_EQ(message.current, -2.0F);
  EXPECT_FLOAT_EQ(message.percentage, 0.25F);
  EXPECT_TRUE(message.present);
}

TEST(Messages, ADoorsModeIsItsChoice) {
  for (const std::uint8_t mode : {angen_msgs::DoorState::OPEN, angen_msgs::DoorState::AJAR}) {
    Reading state;
    state.set("mode", Choice{mode, "any"});
    for (const char* field : {"position", "velocity", "target"}) state.set(field, 0.0);
    angen_msgs::DoorState message;
    fill("door", state, {"bathroom1", "world"}, message);
    EXPECT_EQ(message.name, "bathroom1");
    EXPECT_EQ(message.mode, mode);
  }
}

TEST(Messages, Elevator) {
  Reading state;
  state.set("mode", Choice{2, "DOWN"});
  for (const char* field : {"position", "velocity", "target"}) state.set(field, 0.0);
  state.set("floor", -1);
  state.set("target_floor", 1);
  state.set("floors", 3);
  state.set("door_mode", Choice{4, "BLOCKED"});
  state.set("door_position", 0.3);
  state.set("load", 75.0);
  angen_msgs::ElevatorState message;
  fill("elevator", state, {"elevator", "world"}, message);
  EXPECT_EQ(message.mode, angen_msgs::ElevatorState::DOWN);
  EXPECT_EQ(message.floor, -1);
  EXPECT_EQ(message.target_floor, 1);
  EXPECT_EQ(message.floors, 3);
  EXPECT_EQ(message.door_mode, angen_msgs::ElevatorState::DOOR_BLOCKED);
  EXPECT_EQ(message.door_position, 0.3);
  EXPECT_EQ(message.load, 75.0);
}

TEST(Messages, PersonAndOdometryStandWhereTheyAre) {
  Reading state;
  state.set("mode", Choice{2, "BLOCKED"});
  state.set("x", 1.0);
  state.set("y", 2.0);
  state.set("z", 4.9);
  state.set("yaw", M_PI_2);
  state.set("speed", 0.0);
  state.set("going", true);
  state.set("unreachable", false);
  state.set("why", std::string("no floor"));
  state.set("v", 0.5);
  state.set("w", -1.0);
  state.set("covariance", Numbers{0.1, 0.2, 0.3, 0.2, 0.4, 0.5, 0.3, 0.5, 0.6});
  angen_msgs::PersonState person;
  fill("person", state, {"person", "world"}, person);
  EXPECT_EQ(person.mode, angen_msgs::PersonState::BLOCKED);
  EXPECT_EQ(person.pose.position.z, 4.9);
  EXPECT_TRUE(person.going);
  EXPECT_FALSE(person.unreachable);
  EXPECT_EQ(person.why, "no floor");
  EXPECT_NEAR(person.pose.orientation.z, M_SQRT1_2, 1e-12);
  nav_msgs::Odometry odometry;
  fill("drive", state, {"base_footprint", "odom"}, odometry);
  EXPECT_EQ(odometry.child_frame_id, "base_footprint");
  EXPECT_EQ(odometry.pose.pose.position.y, 2.0);
  EXPECT_EQ(odometry.pose.pose.position.z, 0.0);
  EXPECT_EQ(odometry.twist.twist.linear.x, 0.5);
  EXPECT_EQ(odometry.twist.twist.angular.z, -1.0);
  EXPECT_EQ(odometry.pose.covariance[1], 0.2);   // x with y
  EXPECT_EQ(odometry.pose.covariance[30], 0.3);  // yaw with x
  EXPECT_NEAR(odometry.pose.covariance[35] - odometry.twist.covariance[35], 0.6, 1e-12);
}

TEST(Messages, ContactsAreSplitByPairAndSummed) {
  Reading reading;
  reading.set("collision1", Texts{"chair::body::seat", "chair::body::leg"});
  reading.set("collision2", Texts{"person::body::feet", "flat::floor::box"});
  reading.set("counts", Numbers{2, 1});
  reading.set("positions", Numbers{0, 0, 0.5, 1, 0, 0.5, 0, 0, 0});
  reading.set("normals", Numbers{0, 0, 1, 0, 0, 1, 0, 0, 1});
  reading.set("depths", Numbers{0.001, 0.002, 0.003});
  reading.set("forces", Numbers{0, 0, -10, 0, 0, -20, 0, 0, 30});
  reading.set("frame", "world");
  gazebo_msgs::ContactsState message;
  fill("contact", reading, {"chair", "somewhere"}, message);
  EXPECT_EQ(message.header.frame_id, "world");
  ASSERT_EQ(message.states.size(), 2U);
  const gazebo_msgs::ContactState& seat = message.states[0];
  EXPECT_EQ(seat.collision2_name, "person::body::feet");
  ASSERT_EQ(seat.depths.size(), 2U);
  EXPECT_EQ(seat.contact_positions[1].x, 1.0);
  EXPECT_EQ(seat.total_wrench.force.z, -30.0);
  EXPECT_EQ(seat.wrenches[1].torque.y, 20.0);  // 1 m out, 20 N down
  EXPECT_EQ(seat.total_wrench.torque.y, 20.0);
  ASSERT_EQ(message.states[1].depths.size(), 1U);
  EXPECT_EQ(message.states[1].depths[0], 0.003);
}

TEST(Messages, ContactListsOfUnequalLengthGiveNoMoreThanTheyHold) {
  Reading reading;
  reading.set("collision1", Texts{"a"});
  reading.set("collision2", Texts{"b"});
  reading.set("counts", Numbers{5});
  reading.set("positions", Numbers{0, 0, 0});
  for (const char* field : {"normals", "depths", "forces"}) reading.set(field, Numbers{});
  reading.set("frame", "world");
  gazebo_msgs::ContactsState message;
  fill("contact", reading, {}, message);
  ASSERT_EQ(message.states.size(), 1U);
  EXPECT_TRUE(message.states[0].wrenches.empty());
}

TEST(Messages, TheGenericOneHoldsEveryField) {
  Reading reading;
  reading.kind = "smoke";
  reading.set("alarm", true);
  reading.set("count", 3);
  reading.set("density", 0.5);
  reading.set("state", "ok");
  reading.set("levels", Numbers{1, 2});
  angen_msgs::Reading message;
  fill("smoke", reading, {"s1", "s1"}, message);
  EXPECT_EQ(message.name, "s1");
  EXPECT_EQ(message.kind, "smoke");
  EXPECT_EQ(message.names, (Texts{"alarm", "count", "density", "levels[0]", "levels[1]"}));
  EXPECT_EQ(message.values, (Numbers{1, 3, 0.5, 1, 2}));
  EXPECT_EQ(message.text_names, Texts{"state"});
  EXPECT_EQ(message.texts, Texts{"ok"});
}

TEST(Messages, AMissIsInfiniteInALaserScan) {
  Reading reading;
  reading.set("ranges", std::vector<double>{1.5, std::numeric_limits<double>::infinity()});
  reading.set("angle_min", -0.5);
  reading.set("angle_max", 0.5);
  reading.set("angle_increment", 1.0);
  reading.set("scan_time", 0.1);
  reading.set("range_min", 0.2);
  reading.set("range_max", 8.0);
  sensor_msgs::LaserScan scan;
  fill("lidar", reading, {}, scan);
  ASSERT_EQ(scan.ranges.size(), 2U);
  EXPECT_EQ(scan.ranges[0], 1.5F);
  EXPECT_EQ(scan.ranges[1], std::numeric_limits<float>::infinity());
  EXPECT_EQ(scan.angle_min, -0.5F);
  EXPECT_EQ(scan.angle_max, 0.5F);
  EXPECT_EQ(scan.angle_increment, 1.0F);
  EXPECT_EQ(scan.scan_time, 0.1F);
  EXPECT_EQ(scan.range_min, 0.2F);
  EXPECT_EQ(scan.range_max, 8.0F);
  EXPECT_EQ(scan.intensities, std::vector<float>(2, 0.0F));  // one a ray, as Gazebo's
}

}  // namespace
}  // namespace angen::node
