#pragma once

#include <memory>
#include <string>

#include "core/wheel_errors.h"
#include "devices/refresh.h"
#include "plugin/plugin.h"

namespace angen::devices {

/// Two driven wheels: speeds come in, wheel motors turn, odometry is counted from the wheels.
class Drive : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override;
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  Nanoseconds idle_until(const View& view) const override;

 private:
  struct Wheel {
    JointRef joint;
    double speed = 0.0;     // m/s at the rim, as the motor is commanded
    double angle = 0.0;     // rad, last seen
    double turned = 0.0;    // rad since the start
    double velocity = 0.0;  // rad/s, measured
    double effort = 0.0;    // N m, measured
  };
  struct Odometry {
    double x = 0.0, y = 0.0, yaw = 0.0;  // m, m, rad
    double v = 0.0, w = 0.0;             // m/s, rad/s
    double left = 0.0, right = 0.0;      // rad
    double work = 0.0;                   // J that the motors gave; braking gives none back
    WheelErrors errors;

    bool operator==(const Odometry& o) const {
      return x == o.x && y == o.y && yaw == o.yaw && v == o.v && w == o.w && left == o.left &&
             right == o.right && work == o.work;
    }
  };

  double measure(Wheel& wheel, const View& view) const;  // m it rolled since the last call
  void count(const View& view);
  bool powered(const View& view) const;
  bool lead(Wheel& wheel, double target, double step, Outputs& outputs);

  Wheel left_;
  Wheel right_;
  StateRefresh refresh_;
  double separation_ = 0.0;    // m
  double radius_ = 0.0;        // m
  double torque_ = 0.0;        // N m
  double acceleration_ = 0.0;  // m/s^2
  double max_linear_ = 0.0;    // m/s
  double max_angular_ = 0.0;   // rad/s
  Nanoseconds timeout_ = 0;

  std::string model_;
  bool started_ = false;
  bool powered_ = true;
  bool moving_ = false;
  double v_ = 0.0;  // m/s, commanded
  double w_ = 0.0;  // rad/s, commanded
  Nanoseconds commanded_at_ = 0;
  Odometry odometry_;
  Odometry shown_;
};

class DrivePlugin : public Plugin {
 public:
  const Kind& kind() const override;
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override;
  std::string needs() const override {
    return "joints left_wheel_joint and right_wheel_joint, or those that leftJoint and rightJoint "
           "name";
  }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Drive>(); }
};

}  // namespace angen::devices
