#pragma once

#include <hardware_interface/joint_state_interface.h>

namespace hardware_interface {

class JointHandle : public JointStateHandle {
 public:
  JointHandle(const JointStateHandle& state, double* command)
      : JointStateHandle(state), command_(command) {}
  void setCommand(double command) { *command_ = command; }

 private:
  double* command_;
};

class PositionJointInterface : public Interface<JointHandle> {};
class VelocityJointInterface : public Interface<JointHandle> {};
class EffortJointInterface : public Interface<JointHandle> {};

}  // namespace hardware_interface
