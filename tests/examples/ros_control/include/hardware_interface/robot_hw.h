#pragma once

#include <hardware_interface/joint_command_interface.h>

namespace hardware_interface {

class RobotHW {
 public:
  virtual ~RobotHW() = default;
  void registerInterface(JointStateInterface*) {}
  void registerInterface(PositionJointInterface* interface) { positions = interface; }
  void registerInterface(VelocityJointInterface*) {}
  void registerInterface(EffortJointInterface* interface) { efforts = interface; }

  PositionJointInterface* positions = nullptr;
  EffortJointInterface* efforts = nullptr;
};

}  // namespace hardware_interface
