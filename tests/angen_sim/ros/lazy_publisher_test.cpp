#include "ros/lazy_publisher.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <std_msgs/String.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace angen::node {
namespace {

constexpr int kTopics = 500;
constexpr std::size_t kEach = 50;  // bytes; a handle keeps some 300 of each publisher

/// roscpp without a master, of which each query fails at once.
class LazyPublishers : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("ROS_MASTER_URI", "http://127.0.0.1:1", 1);
    setenv("ROS_HOSTNAME", "localhost", 1);
    ros::console::set_logger_level("ros", ros::console::levels::Fatal);
    ros::init(ros::M_string(), "lazy_publisher_test",
              ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
    ros::master::setRetryTimeout(ros::WallDuration(1e-6));
  }
  static void TearDownTestSuite() { ros::shutdown(); }

  /// Bytes in use after topics have been advertised and ended.
  template <class Make>
  static std::size_t used_after(Make&& make) {
    for (int i = 0; i < kTopics; ++i) make("/topic" + std::to_string(i % 10));
    while (!Registrar::instance().idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return mallinfo2().uordblks;
  }
};

TEST_F(LazyPublishers, LeaveNothingBehind) {
  ros::NodeHandle node;
  const auto make = [&](const std::string& topic) {
    LazyPublisher::of<std_msgs::String>(node, topic, 1);
  };
  const std::size_t before = used_after(make);
  EXPECT_LT(used_after(make), before + kEach * kTopics);
}

TEST_F(LazyPublishers, LatchedOnesLeaveNothingBehind) {
  ros::NodeHandle node;
  const auto make = [&](const std::string& topic) {
    LatchedLazyPublisher<std_msgs::String>(node, topic, 1);
  };
  const std::size_t before = used_after(make);
  EXPECT_LT(used_after(make), before + kEach * kTopics);
}

}  // namespace
}  // namespace angen::node
