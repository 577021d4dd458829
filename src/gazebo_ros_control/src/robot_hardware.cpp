#include "robot_hardware.h"

#include <utility>

namespace angen::node {

RobotHardware::RobotHardware(std::vector<ControlledJoint> joints) : joints_(std::move(joints)) {
  for (ControlledJoint& joint : joints_) {
    const hardware_interface::JointStateHandle state(joint.name, &joint.position, &joint.velocity,
                                                     &joint.effort);
    const hardware_interface::JointHandle handle(state, &joint.command);
    states_.registerHandle(state);
    if (joint.interface == "effort") {
      efforts_.registerHandle(handle);
    } else if (joint.interface == "velocity") {
      velocities_.registerHandle(handle);
    } else {
      positions_.registerHandle(handle);
    }
  }
  registerInterface(&states_);
  registerInterface(&positions_);
  registerInterface(&velocities_);
  registerInterface(&efforts_);
}

void RobotHardware::read(const std::vector<ControlledJoint>& joints) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joints_[i].position = joints[i].position;
    joints_[i].velocity = joints[i].velocity;
    joints_[i].effort = joints[i].effort;
    joints_[i].command = joints[i].command;
  }
}

void RobotHardware::write(std::vector<ControlledJoint>& joints) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) joints[i].command = joints_[i].command;
}

}  // namespace angen::node
