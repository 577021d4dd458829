#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/wheel_errors.h"
#include "plugin/registration.h"
#include "robots/base.h"

namespace angen::robots {

/// A drive's wheels, by its <plugin>.
struct WheelSettings {
  double separation = 0.0;         // m
  double radius = 0.0;             // m
  double torque = 0.0;             // N m
  double acceleration = 0.0;       // m/s^2 at the rim; 0 = at once
  Nanoseconds timeout = kForever;  // it stops this long after a command
  double error = 0.01;             // m, standard deviation of a wheel's way after 1 m
  std::vector<std::string> left;   // joints
  std::vector<std::string> right;
};

/// Driven wheels on both sides of a robot: speeds come in, wheel motors turn.
class Wheels : public Device {
 public:
  Verdict command(const Command& command, const View& view) override;
  void update(const View& view, Outputs& outputs) override;
  void report(const View& view, Reading& state) const override;
  Nanoseconds idle_until(const View&) const override { return ramping_ ? 0 : stops_at_; }

 protected:
  void set_up(WheelSettings settings, Wiring& wiring);
  /// The present command: m/s and rad/s until `until`.
  void roll(double v, double w, Nanoseconds until);

 private:
  struct Side {
    std::vector<JointRef> joints;
    double speed = 0.0;  // m/s at the rim, as the motors are commanded
  };
  bool lead(Side& side, double target, double step, Outputs& outputs) const;

  WheelSettings settings_;
  Side left_;
  Side right_;
  bool ramping_ = true;  // some motor has not its speed yet
  bool started_ = false;
  double v_ = 0.0;  // m/s, commanded
  double w_ = 0.0;  // rad/s, commanded
  Nanoseconds stops_at_ = kForever;
};

/// A robot's pose by the turning of its wheels, one on each side.
class WheelOdometry {
 public:
  void set_up(const WheelSettings& settings, Wiring& wiring);
  /// `gyro` (rad, rad/s), where there is one, has the heading instead of the wheels.
  void read(const View& view, const Base& base, std::optional<std::pair<double, double>> gyro,
            Reading& reading);
  /// The next read() says that it is where its frame is.
  void restart();
  bool rests() const { return rests_; }

 private:
  void count(double left, double right, std::optional<double> turn);

  double separation_ = 0.0;  // m
  double radius_ = 0.0;      // m
  JointRef left_, right_;
  bool started_ = false;
  bool rests_ = false;
  double left_at_ = 0.0, right_at_ = 0.0, heading_ = 0.0;  // rad, at the last sample
  Vec3 at_ = Vec3::Zero();
  double yaw_ = 0.0;
  double error_ = 0.0;  // m, see WheelSettings
  WheelErrors errors_;
};

/// The kind of a device that is commanded by a speed and a turn.
Kind wheels_kind(std::string name, std::string doc);

/// Serves a model that has any of the wheels.
std::vector<Mount> mounts_on_wheels(const ModelInfo& model, const WheelSettings& settings);

/// A drive whose settings come from `read(params)`.
template <WheelSettings (*read)(Params&)>
class WheelsOf : public Wheels {
 public:
  void configure(Params& params, Wiring& wiring) override { set_up(read(params), wiring); }
};

/// Its plug-in; `describe()` is its kind, `Drive` its class.
template <WheelSettings (*read)(Params&), Kind (*describe)(), class Drive = WheelsOf<read>>
class WheelsPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(describe())
  std::vector<Mount> mounts(const ModelInfo& model, Params& params) const override {
    return mounts_on_wheels(model, read(params));
  }
  std::string needs() const override { return "the joints of its wheels"; }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<Drive>(); }
};

}  // namespace angen::robots
