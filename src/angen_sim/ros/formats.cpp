#include "ros/formats.h"

#include <map>

#include "ros/convert.h"
#include "ros/images.h"
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
void publish(const ros::Publisher& publisher, const Reading& reading, Nanoseconds stamp,
             const Label& label) {
  Message message;
  message.header.stamp = to_ros(stamp);
  message.header.frame_id = label.frame;
  fill(reading, label, message);
  publisher.publish(message);
}

template <class Message>
Format format(const std::string& leaf = "", const std::string& leaf_parameter = "") {
  return {ros::message_traits::datatype<Message>(), leaf, leaf_parameter, &advertise<Message>,
          &publish<Message>};
}

}  // namespace

const std::vector<Format>& formats_of(const std::string& kind) {
  static const std::map<std::string, std::vector<Format>> table = {
      {"pir", {format<angen_msgs::PirMsg>()}},
      {"switch", {format<angen_msgs::SwitchMsg>()}},
      {"luminosity", {format<angen_msgs::LightSensMsg>()}},
      {"contact", {format<gazebo_msgs::ContactsState>()}},
      {"lidar", {format<sensor_msgs::LaserScan>()}},
      {"camera",
       {format<sensor_msgs::Image>("image_raw", "imageTopicName"),
        format<sensor_msgs::CameraInfo>("camera_info", "cameraInfoTopicName")}},
      {"depth",
       {format<sensor_msgs::Image>("image_raw", "depthImageTopicName"),
        format<sensor_msgs::CameraInfo>("camera_info", "depthImageCameraInfoTopicName"),
        format<sensor_msgs::PointCloud2>("points", "pointCloudTopicName")}},
      {"door", {format<angen_msgs::DoorState>()}},
      {"elevator", {format<angen_msgs::ElevatorState>()}},
      {"lamp", {format<angen_msgs::LampState>()}},
      {"person", {format<angen_msgs::PersonState>()}},
      {"drive", {format<nav_msgs::Odometry>()}},
  };
  static const std::vector<Format> generic = {format<angen_msgs::Reading>()};
  const auto found = table.find(kind);
  return found == table.end() ? generic : found->second;
}

const Format& format_of(const std::string& kind) { return formats_of(kind).front(); }

}  // namespace angen::node
