#pragma once

#include <string>
#include <vector>

/// Stands in for ros_control, which Debian 12 does not have: as much of its interface as the
/// package gazebo_ros_control uses, so that tests build it.
namespace hardware_interface {

class JointStateHandle {
 public:
  JointStateHandle(const std::string& name, const double* position, const double* velocity,
                   const double* effort)
      : name_(name), position_(position), velocity_(velocity), effort_(effort) {}
  std::string getName() const { return name_; }
  double getPosition() const { return *position_; }
  double getVelocity() const { return *velocity_; }
  double getEffort() const { return *effort_; }

 private:
  std::string name_;
  const double* position_;
  const double* velocity_;
  const double* effort_;
};

template <class Handle>
class Interface {
 public:
  void registerHandle(const Handle& handle) { handles.push_back(handle); }

  std::vector<Handle> handles;
};

class JointStateInterface : public Interface<JointStateHandle> {};

}  // namespace hardware_interface
