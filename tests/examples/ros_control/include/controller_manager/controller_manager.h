#pragma once

#include <hardware_interface/robot_hw.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Empty.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace controller_manager {

/// Leads all joints to the position on the topic `reach`, by positions or by efforts. As the real
/// one's switch_controller, its service `switch` waits for an update.
class ControllerManager {
 public:
  ControllerManager(hardware_interface::RobotHW* robot, const ros::NodeHandle& node)
      : robot_(robot), node_(node, "controller_manager") {
    reach_ = node_.subscribe("reach", 1, &ControllerManager::on_reach, this);
    switch_ = node_.advertiseService("switch", &ControllerManager::wait, this);
  }

  void update(const ros::Time&, const ros::Duration&, bool) {
    updated_ = true;
    if (!wanted_) return;
    for (auto& joint : robot_->positions->handles) joint.setCommand(target_);
    for (auto& joint : robot_->efforts->handles) {
      constexpr double kStiffness = 200.0;  // N m/rad
      constexpr double kDamping = 10.0;     // N m s/rad
      const double left = target_ - joint.getPosition();
      joint.setCommand(kStiffness * left - kDamping * joint.getVelocity());
    }
  }

 private:
  void on_reach(const std_msgs::Float64::ConstPtr& target) {
    target_ = target->data;
    wanted_ = true;
  }
  bool wait(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    updated_ = false;
    while (!updated_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return true;
  }

  hardware_interface::RobotHW* robot_;
  ros::NodeHandle node_;
  ros::Subscriber reach_;
  ros::ServiceServer switch_;
  std::atomic<double> target_{0.0};
  std::atomic<bool> wanted_{false};
  std::atomic<bool> updated_{false};
};

}  // namespace controller_manager
