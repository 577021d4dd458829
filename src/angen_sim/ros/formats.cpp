#include "ros/formats.h"

#include <map>

#include "ros/convert.h"
#include "ros/readings.h"
#include "ros/states.h"

namespace angen::node {
namespace {

template <class Message>
ros::AdvertiseOptions advertise(const std::string& topic, std::uint32_t queue,
                                const ros::SubscriberStatusCallback& joined,
                                const ros::SubscriberStatusCallback& left) {
  ros::AdvertiseOptions options;
  options.init<Message>(topic, queue, joined, left);
  return options;
}

template <class Message>
void publish(const ros::Publisher& publisher, const Reading& reading, const Label& label) {
  Message message;
  message.header.stamp = to_ros(reading.stamp);
  message.header.frame_id = label.frame;
  fill(reading, label, message);
  publisher.publish(message);
}

template <class Message>
Format format() {
  return {ros::message_traits::datatype<Message>(), &advertise<Message>, &publish<Message>};
}

}  // namespace

const Format& format_of(const std::string& kind) {
  static const std::map<std::string, Format> table = {
      {"pir", format<angen_msgs::PirMsg>()},
      {"switch", format<angen_msgs::SwitchMsg>()},
      {"luminosity", format<angen_msgs::LightSensMsg>()},
      {"contact", format<gazebo_msgs::ContactsState>()},
      {"door", format<angen_msgs::DoorState>()},
      {"elevator", format<angen_msgs::ElevatorState>()},
      {"lamp", format<angen_msgs::LampState>()},
      {"person", format<angen_msgs::PersonState>()},
      {"drive", format<nav_msgs::Odometry>()},
  };
  static const Format generic = format<angen_msgs::Reading>();
  const auto found = table.find(kind);
  return found == table.end() ? generic : found->second;
}

}  // namespace angen::node
