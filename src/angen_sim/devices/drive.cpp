// librobot_controller.so
#include "devices/drive.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/text.h"
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
  std::vector<double> values = command.values;
  if (command.verb == "Stop") values = {0.0, 0.0};
  const bool has_power = powered(view);
  if (!has_power) values = {0.0, 0.0};
  return Verdict::accept([this, has_power, v = values[0], w = values[1], now = view.time()] {
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

const Kind& DrivePlugin::kind() const {
  static const Kind kind =
      Kind("drive", "A differential drive with odometry.")
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
          .numbers("covariance", "", "of x, y (m) and yaw (rad), row by row: 9 numbers");
  return kind;
}

// A robot whose wheels another plug-in drives or names is not adopted.
std::vector<Mount> DrivePlugin::mounts(const ModelInfo& model, Params& params) const {
  const ModelInfo::Joint* left = model.joint(left_joint(params));
  const ModelInfo::Joint* right = model.joint(right_joint(params));
  if (left == nullptr || right == nullptr || left->taken || right->taken) return {};
  return {{instance_name(model), left->name}};
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::DrivePlugin)
