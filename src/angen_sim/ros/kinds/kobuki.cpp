#include <kobuki_msgs/BumperEvent.h>
#include <kobuki_msgs/CliffEvent.h>
#include <kobuki_msgs/MotorPower.h>
#include <kobuki_msgs/WheelDropEvent.h>
#include <std_msgs/Empty.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "ros/kinds/states.h"
#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// Parts are numbered as the constants LEFT, … of the message.
struct Bumper {
  using Message = kobuki_msgs::BumperEvent;
  static constexpr std::array<const char*, 3> kParts{"left", "center", "right"};

  static void fill(std::size_t part, bool pressed, const Reading&, Message& event) {
    event.bumper = static_cast<std::uint8_t>(part);
    event.state = pressed ? Message::PRESSED : Message::RELEASED;
  }
};

struct WheelDrop {
  using Message = kobuki_msgs::WheelDropEvent;
  static constexpr std::array<const char*, 2> kParts{"left", "right"};

  static void fill(std::size_t part, bool dropped, const Reading&, Message& event) {
    event.wheel = static_cast<std::uint8_t>(part);
    event.state = dropped ? Message::DROPPED : Message::RAISED;
  }
};

struct Cliff {
  using Message = kobuki_msgs::CliffEvent;
  static constexpr std::array<const char*, 3> kParts{"left", "center", "right"};

  static void fill(std::size_t part, bool cliff, const Reading& reading, Message& event) {
    event.sensor = static_cast<std::uint8_t>(part);
    event.state = cliff ? Message::CLIFF : Message::FLOOR;
    // Gazebo's plug-in has this, too: near floors exceed the 16 bits.
    const double range = reading.get<std::vector<double>>("ranges").at(part);
    event.bottom = static_cast<std::uint16_t>(static_cast<int>(76123.0 * std::atan2(0.995, range)));
  }
};

/// A message for each part whose flag changes.
template <class Event>
class EventChannel : public Channel {
 public:
  EventChannel(ros::NodeHandle& node, const std::string& topic)
      : publisher_(LazyPublisher::of<typename Event::Message>(node, topic, kQueue)) {}
  bool has_subscribers() const override { return true; }  // it follows the parts without any
  void publish(const StampedReading& reading) override {
    if (reading.reading->find(kErrorField) != nullptr) return;
    for (std::size_t i = 0; i < flags_.size(); ++i) follow(i, *reading.reading);
  }

 private:
  static constexpr std::uint32_t kQueue = 20;

  void follow(std::size_t part, const Reading& reading) {
    const bool now = reading.get<bool>(Event::kParts.at(part));
    if (now == flags_.at(part)) return;
    flags_.at(part) = now;
    publisher_.publish([&] {
      typename Event::Message event;
      Event::fill(part, now, reading, event);
      return event;
    });
  }

  LazyPublisher publisher_;
  std::array<bool, Event::kParts.size()> flags_{};
};

template <class Event>
RosKindBuilder events(const std::string& topic) {
  return RosKindBuilder().channel<typename Event::Message, EventChannel<Event>>(topic);
}

// Other states are rejected as unknown verbs.
Command of_power(const kobuki_msgs::MotorPower& power) {
  if (power.state == power.ON) return {"MotorsOn"};
  if (power.state == power.OFF) return {"MotorsOff"};
  return {"MotorPower " + std::to_string(power.state)};
}

Command of_reset(const std_msgs::Empty&) { return {"ResetOdometry"}; }

ANGEN_REGISTER_ROS_KIND({"kobuki"},
                        RosKindBuilder()
                            .commanded_by(&of_twist, "none", "mobile_base/commands/velocity")
                            .commanded_by(&of_power, "none", "mobile_base/commands/motor_power")
                            .commanded_by(&of_reset, "none",
                                          "mobile_base/commands/reset_odometry"));
ANGEN_REGISTER_ROS_KIND({"kobuki_bumper"}, events<Bumper>("mobile_base/events/bumper"));
ANGEN_REGISTER_ROS_KIND({"kobuki_cliff"}, events<Cliff>("mobile_base/events/cliff"));
ANGEN_REGISTER_ROS_KIND({"kobuki_wheel_drop"}, events<WheelDrop>("mobile_base/events/wheel_drop"));

}  // namespace
}  // namespace angen::node
