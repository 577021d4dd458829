#pragma once

#include <gazebo/joint_control.h>
#include <hardware_interface/joint_command_interface.h>
#include <hardware_interface/joint_state_interface.h>
#include <hardware_interface/robot_hw.h>

#include <vector>

namespace angen::node {

/// The joints of a robot, as controllers of ros_control see them.
class RobotHardware : public hardware_interface::RobotHW {
 public:
  /// Offers each of the joints, by the interface that its transmission has.
  explicit RobotHardware(std::vector<ControlledJoint> joints);

  /// Takes the states of the same joints, in the same order.
  void read(const std::vector<ControlledJoint>& joints);
  void write(std::vector<ControlledJoint>& joints) const;

 private:
  std::vector<ControlledJoint> joints_;  // controllers hold pointers to its numbers
  hardware_interface::JointStateInterface states_;
  hardware_interface::PositionJointInterface positions_;
  hardware_interface::VelocityJointInterface velocities_;
  hardware_interface::EffortJointInterface efforts_;
};

}  // namespace angen::node
