#include "robots/wheels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugin/outputs.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::robots {

void Wheels::set_up(WheelSettings settings, Wiring& wiring) {
  settings_ = std::move(settings);
  for (const std::string& name : settings_.left) left_.joints.push_back(wiring.joint(name));
  for (const std::string& name : settings_.right) right_.joints.push_back(wiring.joint(name));
}

Verdict Wheels::command(const Command& command, const View& view) {
  const Nanoseconds until =
      settings_.timeout == kForever ? kForever : view.time() + settings_.timeout;
  return Verdict::accept(
      [this, v = command.values[0], w = command.values[1], until] { roll(v, w, until); });
}

void Wheels::roll(double v, double w, Nanoseconds until) {
  v_ = v;
  w_ = w;
  ramping_ = true;
  stops_at_ = until;
}

void Wheels::update(const View& view, Outputs& outputs) {
  if (view.time() >= stops_at_) roll(0.0, 0.0, kForever);
  if (!ramping_) return;
  const double step = settings_.acceleration * to_seconds(view.step());
  const double turn = w_ * settings_.separation / 2.0;
  const bool left = lead(left_, v_ - turn, step, outputs);
  const bool right = lead(right_, v_ + turn, step, outputs);
  started_ = true;
  ramping_ = !left || !right;
}

// True when the motors have the commanded speed.
bool Wheels::lead(Side& side, double target, double step, Outputs& outputs) const {
  const double next =
      step > 0.0 ? std::clamp(target, side.speed - step, side.speed + step) : target;
  if (next != side.speed || !started_) {
    side.speed = next;
    for (const JointRef joint : side.joints) {
      outputs.motor(joint, next / settings_.radius, settings_.torque);
    }
  }
  return next == target;
}

void Wheels::report(const View&, Reading& state) const {
  state.set("v", v_);
  state.set("w", w_);
  state.set("left", left_.speed);
  state.set("right", right_.speed);
}

void WheelOdometry::set_up(const WheelSettings& settings, Wiring& wiring) {
  separation_ = settings.separation;
  error_ = settings.error;
  radius_ = settings.radius;
  left_ = wiring.joint(settings.left.front());
  right_ = wiring.joint(settings.right.front());
}

void WheelOdometry::read(const View& view, const Base& base,
                         std::optional<std::pair<double, double>> gyro, Reading& reading) {
  const JointView left = view.joint(left_);
  const JointView right = view.joint(right_);
  if (started_) {
    count(left.position - left_at_, right.position - right_at_,
          gyro ? std::make_optional(gyro->first - heading_) : std::nullopt);
  }
  if (!started_) {
    errors_ = {error_, gyro ? std::numeric_limits<double>::infinity() : separation_};
  }
  started_ = true;
  left_at_ = left.position;
  right_at_ = right.position;
  if (gyro) heading_ = gyro->first;
  const double v = (left.velocity + right.velocity) / 2.0 * radius_;
  const double w = (right.velocity - left.velocity) * radius_ / separation_;
  const Quat turned(Eigen::AngleAxisd(yaw_, Vec3::UnitZ()));
  base.read({at_, turned}, turned * Vec3(v, 0.0, 0.0), gyro ? gyro->second : w, reading);
  reading.set("covariance", errors_.numbers());
  rests_ = left.velocity == 0.0 && right.velocity == 0.0 && (!gyro || gyro->second == 0.0);
}

void WheelOdometry::restart() {
  started_ = false;
  at_ = Vec3::Zero();
  yaw_ = 0.0;
}

// Turned angles of the wheels since the last sample, each less than half a turn.
void WheelOdometry::count(double left, double right, std::optional<double> turn) {
  left = std::remainder(left, 2.0 * M_PI) * radius_;
  right = std::remainder(right, 2.0 * M_PI) * radius_;
  const double turned = std::remainder(turn.value_or((right - left) / separation_), 2.0 * M_PI);
  const double middle = yaw_ + turned / 2.0;
  at_ += (left + right) / 2.0 * Vec3(std::cos(middle), std::sin(middle), 0.0);
  errors_.roll(left, right, middle);
  yaw_ = std::remainder(yaw_ + turned, 2.0 * M_PI);
}

std::vector<Mount> mounts_on_wheels(const ModelInfo& model, const WheelSettings& settings) {
  const auto has = [&](const std::string& joint) { return model.joint(joint) != nullptr; };
  const bool any = std::any_of(settings.left.begin(), settings.left.end(), has) ||
                   std::any_of(settings.right.begin(), settings.right.end(), has);
  return any ? std::vector<Mount>{{model.name, ""}} : std::vector<Mount>{};
}

Kind wheels_kind(std::string name, std::string doc) {
  return Kind(std::move(name), std::move(doc))
      .verb("Stop", "stops")
      .value_units({"m/s", "rad/s"})
      .number("v", "m/s", "forward, as commanded")
      .shown(2)
      .number("w", "rad/s", "to the left, as commanded")
      .shown(2)
      .number("left", "m/s", "at the rims of the left wheels, as their motors have it")
      .number("right", "m/s", "at the rims of the right wheels");
}

}  // namespace angen::robots
