#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plugin/reading.h"
#include "ros/convert.h"
#include "ros/lazy_publisher.h"

/// Topics of sensors and devices, by type of message.
namespace angen::node {

/// What a message holds besides the reading.
struct Label {
  std::string name;   // of the sensor or device
  std::string frame;  // header.frame_id
};

/// A reading on its way to a topic.
struct StampedReading {
  std::shared_ptr<const Reading> reading;
  Nanoseconds stamp = 0;
  std::shared_ptr<const Label> label;
};

/// A topic of one sensor or device, or of several. Messages are made for subscribers only.
class Channel {
 public:
  virtual ~Channel() = default;
  virtual bool has_subscribers() const = 0;
  virtual void publish(const StampedReading& reading) = 0;
  /// Whether readings wait for flush(), which publishes all of them in one message.
  virtual bool batches() const { return false; }
  virtual void flush(Nanoseconds) {}
};

/// Fills in a message's fields but its header.
template <class Message>
using Fill = void (*)(const Reading& reading, const Label& label, Message& message);

template <class Message>
Message to_message(const StampedReading& reading, Fill<Message> fill) {
  Message message;
  message.header.stamp = to_ros(reading.stamp);
  message.header.frame_id = reading.label->frame;
  fill(*reading.reading, *reading.label, message);
  return message;
}

/// So many messages wait for a slow subscriber. Pictures, of megabytes each, are fewer.
template <class Message>
std::uint32_t queue_length() {
  const std::string type = ros::message_traits::datatype<Message>();
  return type == "sensor_msgs/Image" || type == "sensor_msgs/PointCloud2" ? 4 : 20;
}

/// A message for each reading.
template <class Message>
class EachChannel : public Channel {
 public:
  EachChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(LazyPublisher::of<Message>(node, topic, queue_length<Message>())), fill_(fill) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  void publish(const StampedReading& reading) override {
    publisher_.publish([&] { return to_message<Message>(reading, fill_); });
  }

 private:
  LazyPublisher publisher_;
  Fill<Message> fill_;
};

/// A message for each state; the last one is latched.
template <class Message>
class LatchedChannel : public Channel {
 public:
  LatchedChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(node, topic, kQueue), fill_(fill) {}
  bool has_subscribers() const override { return true; }
  void publish(const StampedReading& reading) override {
    if (reading.reading == last_) return;
    last_ = reading.reading;
    publisher_.set([reading, fill = fill_] { return to_message<Message>(reading, fill); });
  }

 private:
  static constexpr std::uint32_t kQueue = 100;  // a second of a moving door's states

  LatchedLazyPublisher<Message> publisher_;
  Fill<Message> fill_;
  std::shared_ptr<const Reading> last_;
};

/// One message for all readings between two flushes: `Array` has names and readings.
template <class Array, class Message>
class BatchChannel : public Channel {
 public:
  BatchChannel(ros::NodeHandle& node, const std::string& topic, Fill<Message> fill)
      : publisher_(LazyPublisher::of<Array>(node, topic, kQueue)), fill_(fill) {}
  bool has_subscribers() const override { return publisher_.has_subscribers(); }
  bool batches() const override { return true; }
  void publish(const StampedReading& reading) override {
    if (has_subscribers()) pending_.push_back(reading);
  }
  void flush(Nanoseconds now) override {
    if (pending_.empty()) return;
    publisher_.publish([&] { return collect(now); });
    pending_.clear();
  }

 private:
  static constexpr std::uint32_t kQueue = 20;

  Array collect(Nanoseconds now) const {
    Array array;
    array.header.stamp = to_ros(now);
    array.names.reserve(pending_.size());
    array.readings.reserve(pending_.size());
    for (const StampedReading& reading : pending_) {
      array.names.push_back(reading.label->name);
      array.readings.push_back(to_message<Message>(reading, fill_));
    }
    return array;
  }

  LazyPublisher publisher_;
  Fill<Message> fill_;
  std::vector<StampedReading> pending_;
};

}  // namespace angen::node
