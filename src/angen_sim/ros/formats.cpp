#include "ros/formats.h"

#include <angen_msgs/ContactsArray.h>
#include <angen_msgs/LightSensArray.h>
#include <angen_msgs/PirArray.h>
#include <angen_msgs/ReadingArray.h>
#include <angen_msgs/SwitchArray.h>

#include <map>
#include <utility>

#include "ros/convert.h"
#include "ros/images.h"
#include "ros/lazy_publisher.h"
#include "ros/readings.h"
#include "ros/states.h"

namespace angen::node {
namespace {

constexpr std::uint32_t kStateQueue = 100;  // a second of all that a moving door says
constexpr std::uint32_t kReadingQueue = 20;

template <class Message>
Message to_message(const Parcel& parcel) {
  Message message;
  message.header.stamp = to_ros(parcel.stamp);
  message.header.frame_id = parcel.label->frame;
  fill(*parcel.reading, *parcel.label, message);
  return message;
}

template <class Message>
class Each : public Channel {
 public:
  Each(ros::NodeHandle& node, const std::string& topic)
      : publisher_(LazyPublisher::of<Message>(node, topic, kReadingQueue)) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  void put(const Parcel& parcel) override {
    publisher_.publish([&] { return to_message<Message>(parcel); });
  }

 private:
  LazyPublisher publisher_;
};

template <class Message>
class Latched : public Channel {
 public:
  Latched(ros::NodeHandle& node, const std::string& topic) : publisher_(node, topic, kStateQueue) {}
  bool has_subscribers() const override { return true; }
  void put(const Parcel& parcel) override {
    if (parcel.reading == last_) return;
    last_ = parcel.reading;
    publisher_.set([parcel] { return to_message<Message>(parcel); });
  }

 private:
  LatchedLazyPublisher<Message> publisher_;
  std::shared_ptr<const Reading> last_;
};

template <class Array, class Message>
class Together : public Channel {
 public:
  Together(ros::NodeHandle& node, const std::string& topic)
      : publisher_(LazyPublisher::of<Array>(node, topic, kReadingQueue)) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  bool collects() const override { return true; }
  void put(const Parcel& parcel) override {
    if (has_subscribers()) pending_.push_back(parcel);
  }
  void flush(Nanoseconds now) override {
    if (pending_.empty()) return;
    publisher_.publish([&] { return collect(now); });
    pending_.clear();
  }

 private:
  Array collect(Nanoseconds now) const {
    Array array;
    array.header.stamp = to_ros(now);
    array.names.reserve(pending_.size());
    array.readings.reserve(pending_.size());
    for (const Parcel& parcel : pending_) {
      array.names.push_back(parcel.label->name);
      array.readings.push_back(to_message<Message>(parcel));
    }
    return array;
  }

  LazyPublisher publisher_;
  std::vector<Parcel> pending_;
};

template <class Kind>
std::unique_ptr<Channel> open(ros::NodeHandle& node, const std::string& topic) {
  return std::make_unique<Kind>(node, topic);
}

template <class Message>
Format format(const std::string& leaf = "", const std::string& leaf_parameter = "") {
  Format made;
  made.type = ros::message_traits::datatype<Message>();
  made.leaf = leaf;
  made.leaf_parameter = leaf_parameter;
  made.open = &open<Each<Message>>;
  made.latched = &open<Latched<Message>>;
  return made;
}

/// Of a kind of which there may be thousands.
template <class Message, class Array>
Format format_with_array() {
  Format made = format<Message>();
  made.array_type = ros::message_traits::datatype<Array>();
  made.array = &open<Together<Array, Message>>;
  return made;
}

}  // namespace

const std::vector<Format>& formats_of(const std::string& kind) {
  static const std::map<std::string, std::vector<Format>> table = {
      {"pir", {format_with_array<angen_msgs::PirMsg, angen_msgs::PirArray>()}},
      {"switch", {format_with_array<angen_msgs::SwitchMsg, angen_msgs::SwitchArray>()}},
      {"luminosity", {format_with_array<angen_msgs::LightSensMsg, angen_msgs::LightSensArray>()}},
      {"contact", {format_with_array<gazebo_msgs::ContactsState, angen_msgs::ContactsArray>()}},
      {"lidar", {format<sensor_msgs::LaserScan>()}},
      {"proximity", {format<sensor_msgs::Range>()}},
      {"pressure", {format<angen_msgs::PressureMsg>()}},
      {"reed", {format<angen_msgs::ReedMsg>()}},
      {"rfid", {format<angen_msgs::RfidMsg>()}},
      {"plug", {format<angen_msgs::PlugMsg>()}},
      {"temperature", {format<sensor_msgs::Temperature>()}},
      {"humidity", {format<sensor_msgs::RelativeHumidity>()}},
      {"camera",
       {format<sensor_msgs::Image>("image_raw", "imageTopicName"),
        format<sensor_msgs::CameraInfo>("camera_info", "cameraInfoTopicName")}},
      {"depth",
       {format<sensor_msgs::Image>("image_raw", "depthImageTopicName"),
        format<sensor_msgs::CameraInfo>("camera_info", "depthImageCameraInfoTopicName"),
        format<sensor_msgs::PointCloud2>("points", "pointCloudTopicName")}},
      {"door", {format<angen_msgs::DoorState>()}},
      {"window", {format<angen_msgs::DoorState>()}},
      {"cabinet", {format<angen_msgs::DoorState>()}},
      {"elevator", {format<angen_msgs::ElevatorState>()}},
      {"lamp", {format<angen_msgs::LampState>()}},
      {"person", {format<angen_msgs::PersonState>()}},
      {"battery", {format<sensor_msgs::BatteryState>()}},
      {"drive", {format<nav_msgs::Odometry>()}},
  };
  static const std::vector<Format> generic = {
      format_with_array<angen_msgs::Reading, angen_msgs::ReadingArray>()};
  const auto found = table.find(kind);
  return found == table.end() ? generic : found->second;
}

const Format& format_of(const std::string& kind) { return formats_of(kind).front(); }

}  // namespace angen::node
