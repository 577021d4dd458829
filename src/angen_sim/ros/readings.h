#pragma once

#include <angen_msgs/LightSensMsg.h>
#include <angen_msgs/PirMsg.h>
#include <angen_msgs/PlugMsg.h>
#include <angen_msgs/PressureMsg.h>
#include <angen_msgs/Reading.h>
#include <angen_msgs/ReedMsg.h>
#include <angen_msgs/RfidMsg.h>
#include <angen_msgs/SwitchMsg.h>
#include <gazebo_msgs/ContactsState.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/RelativeHumidity.h>
#include <sensor_msgs/Temperature.h>

#include "ros/formats.h"

/// What sensors measured, as messages; the caller fills the headers.
namespace angen::node {

void fill(const Reading& reading, const Label& label, angen_msgs::PirMsg& message);
void fill(const Reading& reading, const Label& label, angen_msgs::SwitchMsg& message);
void fill(const Reading& reading, const Label& label, angen_msgs::LightSensMsg& message);
void fill(const Reading& reading, const Label& label, sensor_msgs::LaserScan& message);
/// Infinite where nothing is in reach (REP 117).
void fill(const Reading& reading, const Label& label, sensor_msgs::Range& message);
void fill(const Reading& reading, const Label& label, angen_msgs::PressureMsg& message);
void fill(const Reading& reading, const Label& label, angen_msgs::ReedMsg& message);
void fill(const Reading& reading, const Label& label, angen_msgs::RfidMsg& message);
void fill(const Reading& reading, const Label& label, angen_msgs::PlugMsg& message);
void fill(const Reading& reading, const Label& label, sensor_msgs::Temperature& message);
/// Between 0 and 1, as that message has it.
void fill(const Reading& reading, const Label& label, sensor_msgs::RelativeHumidity& message);
/// In the world frame, whatever the label says; torques are about its origin.
void fill(const Reading& reading, const Label& label, gazebo_msgs::ContactsState& message);

/// Any reading: flags and counts as numbers, an array as NAME[0], NAME[1], …
void fill(const Reading& reading, const Label& label, angen_msgs::Reading& message);

}  // namespace angen::node
