#include <controller_manager/controller_manager.h>
#include <core/text.h>
#include <ros/callback_queue.h>
#include <std_msgs/Bool.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "robot_hardware.h"

namespace angen::node {
namespace {

// <controlPeriod>, s; 0: each tick.
Nanoseconds period_of(const Element& plugin) {
  const std::optional<double> period = parse_finite(plugin.child_text("controlPeriod"));
  return period && *period > 0.0 ? from_seconds(*period) : 0;
}

ros::Time ros_time(Nanoseconds time) {
  ros::Time stamp;
  return stamp.fromNSec(static_cast<std::uint64_t>(time));
}

/// A controller manager and its controllers. They are called back in a thread of their own, since
/// services of the manager wait for updates.
class RosControl : public JointControl {
 public:
  RosControl(const Element& plugin, const std::string& space,
             const std::vector<ControlledJoint>& joints)
      : period_(period_of(plugin)), hardware_(joints), node_(space) {
    node_.setCallbackQueue(&queue_);
    const std::string stop = plugin.child_text("eStopTopic");
    if (!stop.empty()) stop_ = node_.subscribe(stop, 1, &RosControl::on_stop, this);
    manager_ = std::make_unique<controller_manager::ControllerManager>(&hardware_, node_);
    thread_ = std::thread([this] { serve(); });
  }

  ~RosControl() override {
    ends_ = true;
    while (!ended_) {  // a service may wait for an update
      manager_->update(ros_time(time_), ros::Duration(), false);
      std::this_thread::sleep_for(kPollPeriod);
    }
    thread_.join();
  }
  RosControl(const RosControl&) = delete;
  RosControl& operator=(const RosControl&) = delete;

  void update(Nanoseconds time, std::vector<ControlledJoint>& joints) override {
    const bool again = time < time_;  // the world was reset
    const Nanoseconds passed = again ? period_ : time - time_;
    if (passed < period_) return;
    time_ = time;
    const bool stopped = stop_requested_;
    hardware_.read(joints);
    manager_->update(ros_time(time), ros::Duration().fromNSec(passed),
                     again || (stopped_ && !stopped));
    if (!stopped) {
      hardware_.write(joints);
    } else if (!stopped_) {
      hold_still(joints);
    }
    stopped_ = stopped;
  }

 private:
  static constexpr std::chrono::milliseconds kPollPeriod{1};
  static constexpr double kNap = 0.05;  // s

  static void hold_still(std::vector<ControlledJoint>& joints) {
    for (ControlledJoint& joint : joints) {
      joint.command = joint.interface == "position" ? joint.position : 0.0;
    }
  }

  void serve() {
    while (!ends_) queue_.callAvailable(ros::WallDuration(kNap));
    ended_ = true;
  }

  void on_stop(const std_msgs::Bool::ConstPtr& stop) { stop_requested_ = stop->data != 0; }

  Nanoseconds period_;
  Nanoseconds time_ = 0;  // time of the last update
  RobotHardware hardware_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Subscriber stop_;
  std::unique_ptr<controller_manager::ControllerManager> manager_;
  std::thread thread_;
  std::atomic<bool> stop_requested_{false};
  std::atomic<bool> ends_{false};
  std::atomic<bool> ended_{false};
  bool stopped_ = false;
};

const JointControlRegistration registration("libgazebo_ros_control.so",
                                            [](const Element& plugin, const std::string& space,
                                               const std::vector<ControlledJoint>& joints) {
                                              return std::make_unique<RosControl>(plugin, space,
                                                                                  joints);
                                            });

}  // namespace
}  // namespace angen::node
