#include <kobuki_msgs/BumperEvent.h>

#include <array>

#include "ros/ros_kind.h"

namespace angen::node {
namespace {

/// A message for each part that is pressed or comes free.
class BumperChannel : public Channel {
 public:
  BumperChannel(ros::NodeHandle& node, const std::string& topic)
      : publisher_(LazyPublisher::of<kobuki_msgs::BumperEvent>(node, topic, kQueue)) {}
  bool has_subscribers() const override { return true; }  // it follows the parts without any
  void publish(const StampedReading& reading) override {
    if (reading.reading->find(kErrorField) != nullptr) return;
    for (std::size_t i = 0; i < kParts.size(); ++i) follow(i, *reading.reading);
  }

 private:
  static constexpr std::uint32_t kQueue = 20;
  static constexpr std::array<const char*, 3> kParts{"left", "center", "right"};  // LEFT, …

  void follow(std::size_t part, const Reading& reading) {
    const bool now = reading.get<bool>(kParts.at(part));
    if (now == pressed_.at(part)) return;
    pressed_.at(part) = now;
    publisher_.publish([&] {
      kobuki_msgs::BumperEvent event;
      event.bumper = static_cast<std::uint8_t>(part);
      event.state = now ? event.PRESSED : event.RELEASED;
      return event;
    });
  }

  LazyPublisher publisher_;
  std::array<bool, 3> pressed_{};
};

ANGEN_REGISTER_ROS_KIND(
    {"kobuki_bumper"},
    RosKindBuilder().channel<kobuki_msgs::BumperEvent, BumperChannel>("mobile_base/events/bumper"));

}  // namespace
}  // namespace angen::node
