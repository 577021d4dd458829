// librobot_controller.so
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/text.h"
#include "core/wheel_errors.h"
#include "devices/refresh.h"
#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::devices {

namespace {

constexpr double kRestSpeed = 1e-4;  // rad/s: slower wheels are at rest
constexpr double kFarOff =
    0.1;  // share of the wheels' distance by which wheelSeparation may be wrong

std::string left_joint(Params& params) {
  return params.text("leftJoint", "left_wheel_joint", "joint, axis +y");
}
std::string right_joint(Params& params) {
  return params.text("rightJoint", "right_wheel_joint", "joint, axis +y");
}

}  // namespace

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

void Drive::configure(Params& params, Wiring& wiring) {
  separation_ = params.number("wheelSeparation", 0.23, "m", "between the wheels", kPositive);
  radius_ = params.number("wheelDiameter", 0.07, "m", "diameter of a wheel", kPositive) / 2.0;
  torque_ = params.number("wheelTorque", 1.0, "N m", "greatest torque of a wheel", kPositive);
  acceleration_ =
      params.number("wheelAcceleration", 1.0, "m/s^2", "acceleration at a wheel's rim", kPositive);
  max_linear_ = params.number("max_linear_velocity", 0.7, "m/s", "fastest drive", kPositive);
  max_angular_ = params.number("max_angular_velocity", 3.1, "rad/s", "fastest turn", kPositive);
  odometry_.errors = shown_.errors = WheelErrors(
      params.number("wheelError", 0.01, "m",
                    "standard deviation of a wheel's way after 1 m, in covariances", kNotNegative),
      separation_);
  timeout_ = from_seconds(params.number("commandTimeout", 0.6, "s",
                                        "it stops this long after the last command", kPositive));
  refresh_ =
      StateRefresh(params.number("updateRate", 50.0, "Hz", "rate of odometry", kRefreshRate));
  params.text("commandTopic", "cmd_vel", "where commands come from");
  params.text("odometryTopic", "odom", "of its odometry");
  params.text("odometryFrame", "odom", "frame that odometry starts in");
  params.text("robotBaseFrame", "base_footprint", "frame that odometry moves");
  model_ = wiring.model();
  left_.joint = wiring.joint(left_joint(params));
  right_.joint = wiring.joint(right_joint(params));
  const double apart = (wiring.anchor(left_.joint) - wiring.anchor(right_.joint)).norm();
  if (apart > 0.0 && std::abs(apart - separation_) > kFarOff * apart) {
    params.warn("wheelSeparation", "<wheelSeparation> is " + number_text(separation_) +
                                       " m, but the wheels of model '" + model_ + "' are " +
                                       number_text(apart) +
                                       " m apart: it turns by another angle "
                                       "than it is commanded; give the model a plug-in of its own");
  }
}

Verdict Drive::command(const Command& command, const View& view) {
  const bool has_power = powered(view);
  const double v = has_power ? command.values[0] : 0.0;
  const double w = has_power ? command.values[1] : 0.0;
  return Verdict::accept([this, has_power, v, w, now = view.time()] {
    powered_ = has_power;
    v_ = std::clamp(v, -max_linear_, max_linear_);
    w_ = std::clamp(w, -max_angular_, max_angular_);
    commanded_at_ = now;
    moving_ = moving_ || v_ != 0.0 || w_ != 0.0;
  });
}

void Drive::update(const View& view, Outputs& outputs) {
  if (!started_) {
    started_ = true;
    left_.angle = view.joint(left_.joint).position;
    right_.angle = view.joint(right_.joint).position;
    outputs.motor(left_.joint, 0.0, torque_);
    outputs.motor(right_.joint, 0.0, torque_);
  }
  const bool renew = refresh_.due(view.time(), view.step());
  if (!moving_ && !renew) return;
  if (renew) powered_ = powered(view);
  count(view);
  if (moving_) {
    if (!powered_ || view.time() - commanded_at_ >= timeout_) v_ = w_ = 0.0;
    const double step = acceleration_ * to_seconds(view.step());
    const bool at_rest = lead(left_, v_ - w_ * separation_ / 2.0, step, outputs) &
                         lead(right_, v_ + w_ * separation_ / 2.0, step, outputs);
    if (at_rest) {
      moving_ = false;
      outputs.event("stopped", "");
    }
  }
  if (renew) shown_ = odometry_;
}

// A robot whose battery is empty stops.
bool Drive::powered(const View& view) const {
  for (const DeviceView& device : view.devices("empty")) {
    if (device.model == model_ && device.state.get<bool>("empty")) return false;
  }
  return true;
}

// True when the wheel is commanded to stop and is at rest.
bool Drive::lead(Wheel& wheel, double target, double step, Outputs& outputs) {
  const double next = std::clamp(target, wheel.speed - step, wheel.speed + step);
  if (next != wheel.speed) {
    wheel.speed = next;
    outputs.motor(wheel.joint, next / radius_, torque_);
  }
  return wheel.speed == 0.0 && target == 0.0 && std::abs(wheel.velocity) < kRestSpeed;
}

double Drive::measure(Wheel& wheel, const View& view) const {
  const JointView joint = view.joint(wheel.joint);
  // An angle given modulo a turn still gives the right difference.
  const double turned = std::remainder(joint.position - wheel.angle, 2.0 * M_PI);
  wheel.angle = joint.position;
  wheel.turned += turned;
  wheel.velocity = joint.velocity;
  wheel.effort = joint.effort;
  return turned * radius_;
}

void Drive::count(const View& view) {
  const double left = measure(left_, view);
  const double right = measure(right_, view);
  const double turn = (right - left) / separation_;
  const double middle = odometry_.yaw + turn / 2.0;
  odometry_.x += (left + right) / 2.0 * std::cos(middle);
  odometry_.y += (left + right) / 2.0 * std::sin(middle);
  odometry_.errors.roll(left, right, middle);
  odometry_.yaw = std::remainder(odometry_.yaw + turn, 2.0 * M_PI);
  odometry_.v = (left_.velocity + right_.velocity) / 2.0 * radius_;
  odometry_.w = (right_.velocity - left_.velocity) / separation_ * radius_;
  if (moving_) {
    const double power = std::max(0.0, left_.effort * left_.velocity) +
                         std::max(0.0, right_.effort * right_.velocity);
    odometry_.work += power * to_seconds(view.step());
  }
  odometry_.left = left_.turned;
  odometry_.right = right_.turned;
}

Nanoseconds Drive::idle_until(const View& view) const {
  if (moving_ || !started_) return 0;
  const auto counted = [&](const Wheel& wheel) {
    const JointView joint = view.joint(wheel.joint);
    return joint.position == wheel.angle && joint.velocity == wheel.velocity;
  };
  const bool up_to_date = shown_ == odometry_ && counted(left_) && counted(right_);
  return up_to_date ? kForever : refresh_.next(view.time());
}

void Drive::report(const View&, Reading& state) const {
  state.set("x", shown_.x);
  state.set("y", shown_.y);
  state.set("yaw", shown_.yaw);
  state.set("v", shown_.v);
  state.set("w", shown_.w);
  state.set("left", shown_.left);
  state.set("right", shown_.right);
  state.set("work", shown_.work);
  state.set("covariance", shown_.errors.numbers());
}

class DrivePlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Kind("drive", "A differential drive with odometry.")
                         .travels("robots")
                         .model("turtlebot")
                         .example("set drive turtlebot stop")
                         .verb("Stop", "stops")
                         .value_units({"m/s", "rad/s"})
                         .number("x", "m", "by the wheels, in the odometry frame")
                         .shown(2)
                         .number("y", "m", "by the wheels")
                         .shown(2)
                         .number("yaw", "rad", "by the wheels")
                         .shown(2)
                         .number("v", "m/s", "forward")
                         .shown(2)
                         .number("w", "rad/s", "to the left")
                         .shown(2)
                         .number("left", "rad", "angle of the left wheel")
                         .number("right", "rad", "angle of the right wheel")
                         .number("work", "J", "of the motors since the start")
                         .numbers("covariance", "",
                                  "of x, y (m) and yaw (rad), row by row: 9 numbers"))
  // A robot whose wheels another plug-in drives or names is not adopted.
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override {
    const ModelInfo::Joint* left = model.joint(left_joint(params));
    const ModelInfo::Joint* right = model.joint(right_joint(params));
    if (left == nullptr || right == nullptr || left->taken || right->taken) return {};
    return {{instance_name(model), left->name}};
  }
  std::string needs() const override {
    return "joints left_wheel_joint and right_wheel_joint, or those that leftJoint and rightJoint "
           "name";
  }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Drive>(); }
};

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::DrivePlugin)
