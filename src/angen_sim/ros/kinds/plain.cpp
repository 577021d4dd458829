// Kinds whose messages have the fields of their readings (ros/by_name.h), or few others.
#include <angen_msgs/DoorStateArray.h>
#include <angen_msgs/ElevatorStateArray.h>
#include <angen_msgs/LampStateArray.h>
#include <angen_msgs/LightSensArray.h>
#include <angen_msgs/PersonStateArray.h>
#include <angen_msgs/PirArray.h>
#include <angen_msgs/PlugMsg.h>
#include <angen_msgs/PressureMsg.h>
#include <angen_msgs/ReedMsg.h>
#include <angen_msgs/RfidMsg.h>
#include <angen_msgs/RssiMsg.h>
#include <angen_msgs/SwitchArray.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/RelativeHumidity.h>
#include <sensor_msgs/Temperature.h>

#include <algorithm>

#include "ros/convert.h"
#include "ros/kinds/frames.h"
#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// Between 0 and 1, as that message has it.
void fill(const Reading& reading, const Label&, sensor_msgs::RelativeHumidity& message) {
  message.relative_humidity = reading.get<double>("humidity") / 100.0;
  message.variance = reading.get<double>("variance") / 1e4;
}

void fill(const Reading& state, const Label& label, angen_msgs::LampState& message) {
  fill_by_name(state, label, message, {"illuminance"});
}

void fill(const Reading& state, const Label& label, angen_msgs::PersonState& message) {
  fill_by_name(state, label, message);
  message.pose = to_ros(flat_pose(state, state.get<double>("z")));
}

void fill(const Reading& reading, const Label& label, angen_msgs::PirMsg& message) {
  fill_by_name(reading, label, message, {"departure", "difference", "threshold"});
}

void fill(const Reading& reading, const Label& label, sensor_msgs::LaserScan& message) {
  fill_by_name(reading, label, message, {"time_increment", "intensities"});
  message.intensities.assign(message.ranges.size(), 0.0F);  // no surface has a <laser_retro> here
}

/// The range is max_range if nothing is in reach, as in gazebo_ros_range: range_sensor_layer drops
/// infinite ranges.
void fill(const Reading& reading, const Label& label, sensor_msgs::Range& message) {
  fill_by_name(reading, label, message, {"radiation_type"});
  message.radiation_type =
      reading.get<bool>("infrared") ? sensor_msgs::Range::INFRARED : sensor_msgs::Range::ULTRASOUND;
  message.range = std::min(message.range, message.max_range);
}

RosKindBuilder leaf() {
  return RosKindBuilder().message_with_array<angen_msgs::DoorState, angen_msgs::DoorStateArray>();
}

ANGEN_REGISTER_ROS_KIND({"door"}, leaf().label("door labels"));
ANGEN_REGISTER_ROS_KIND({"window", "cabinet"}, leaf());
ANGEN_REGISTER_ROS_KIND(
    {"elevator"},
    RosKindBuilder()
        .message_with_array<angen_msgs::ElevatorState, angen_msgs::ElevatorStateArray>());
ANGEN_REGISTER_ROS_KIND({"humidity"},
                        RosKindBuilder().message<sensor_msgs::RelativeHumidity>(&fill).caption());
ANGEN_REGISTER_ROS_KIND(
    {"lamp"}, RosKindBuilder()
                  .message_with_array<angen_msgs::LampState, angen_msgs::LampStateArray>(&fill)
                  .label("labels"));
ANGEN_REGISTER_ROS_KIND({"lidar"}, RosKindBuilder().message<sensor_msgs::LaserScan>(&fill));
ANGEN_REGISTER_ROS_KIND(
    {"luminosity"},
    RosKindBuilder().message_with_array<angen_msgs::LightSensMsg, angen_msgs::LightSensArray>());
ANGEN_REGISTER_ROS_KIND(
    {"person"},
    RosKindBuilder()
        .message_with_array<angen_msgs::PersonState, angen_msgs::PersonStateArray>(&fill)
        .label("labels"));
ANGEN_REGISTER_ROS_KIND({"pir"},
                        RosKindBuilder()
                            .message_with_array<angen_msgs::PirMsg, angen_msgs::PirArray>(&fill)
                            .rays("PIR rays", color(1.0F, 0.25F, 0.1F, 0.8F)));
ANGEN_REGISTER_ROS_KIND({"plug"}, RosKindBuilder().message<angen_msgs::PlugMsg>().caption());
ANGEN_REGISTER_ROS_KIND({"pressure"},
                        RosKindBuilder().message<angen_msgs::PressureMsg>().caption());
ANGEN_REGISTER_ROS_KIND({"proximity"}, RosKindBuilder().message<sensor_msgs::Range>(&fill).rays(
                                           "proximity cones", color(0.9F, 0.5F, 0.1F, 0.8F)));
ANGEN_REGISTER_ROS_KIND({"receiver"}, RosKindBuilder().message<angen_msgs::RssiMsg>().caption());
ANGEN_REGISTER_ROS_KIND({"reed"}, RosKindBuilder().message<angen_msgs::ReedMsg>().caption());
ANGEN_REGISTER_ROS_KIND({"rfid"}, RosKindBuilder().message<angen_msgs::RfidMsg>().caption());
ANGEN_REGISTER_ROS_KIND({"sonar"}, RosKindBuilder()
                                       .named_message<sensor_msgs::Range>(&fill, "sonar")
                                       .frame(frame_by({"frameId", "bodyName"}))
                                       .rays("proximity cones", color(0.9F, 0.5F, 0.1F, 0.8F)));
ANGEN_REGISTER_ROS_KIND({"switch"},
                        RosKindBuilder()
                            .message_with_array<angen_msgs::SwitchMsg, angen_msgs::SwitchArray>()
                            .rays("switch beams", color(0.1F, 0.8F, 0.2F, 1.0F)));
ANGEN_REGISTER_ROS_KIND({"temperature"},
                        RosKindBuilder().message<sensor_msgs::Temperature>().caption());

}  // namespace
}  // namespace angen::node
