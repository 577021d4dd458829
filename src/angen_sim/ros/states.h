#pragma once

#include <angen_msgs/DoorState.h>
#include <angen_msgs/ElevatorState.h>
#include <angen_msgs/LampState.h>
#include <angen_msgs/PersonState.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>

#include "core/pose.h"
#include "ros/formats.h"

/// What devices report, as messages; the caller fills the headers.
namespace angen::node {

void fill(const Reading& state, const Label& label, angen_msgs::DoorState& message);
void fill(const Reading& state, const Label& label, angen_msgs::ElevatorState& message);
void fill(const Reading& state, const Label& label, angen_msgs::LampState& message);
void fill(const Reading& state, const Label& label, angen_msgs::PersonState& message);
void fill(const Reading& state, const Label& label, sensor_msgs::BatteryState& message);
/// child_frame_id is label.name here.
void fill(const Reading& state, const Label& label, nav_msgs::Odometry& message);

/// Where wheels say that a robot is, in its odometry frame.
Pose odometry_pose(const Reading& state);

}  // namespace angen::node
