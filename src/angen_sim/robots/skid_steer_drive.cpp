#include "plugin/register.h"
#include "robots/wheels.h"

namespace angen::robots {

namespace {

struct Skid {
  double separation, radius, torque;
  std::string left_front, left_rear, right_front, right_rear;
};

Skid read_skid(Params& params) {
  Skid s;
  read_topics(params);
  s.separation = params.number("wheelSeparation", 0.4, "m", "between left and right", kPositive);
  s.radius = params.number("wheelDiameter", 0.15, "m", "diameter of a wheel", kPositive) / 2.0;
  s.torque = params.number("torque", 5.0, "N m", "greatest torque of a wheel", kPositive);
  const auto joint = [&](const char* path, const char* fallback) {
    return params.text(path, fallback, "joint of that wheel");
  };
  s.left_front = joint("leftFrontJoint", "left_front_joint");
  s.left_rear = joint("leftRearJoint", "left_rear_joint");
  s.right_front = joint("rightFrontJoint", "right_front_joint");
  s.right_rear = joint("rightRearJoint", "right_rear_joint");
  params.flag("broadcastTF", true, "the transform from odometry to base is published");
  for (const char* path : {"covariance_x", "covariance_y", "covariance_yaw"}) {
    params.number(path, 1e-4, "", "not used: the odometry is the truth", kNotNegative);
  }
  return s;
}

}  // namespace

/// Two driven wheels on each side, which slip when it turns.
class SkidSteer : public Wheels {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const Skid s = read_skid(params);
    set_up({s.separation, s.radius, s.torque, 0.0},
           {wiring.joint(s.left_front), wiring.joint(s.left_rear)},
           {wiring.joint(s.right_front), wiring.joint(s.right_rear)});
  }
};

class SkidSteerPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind = wheels_kind("skid_steer_drive", "Two driven wheels on each side.");
    return kind;
  }
  bool serves(const ModelInfo&) const override { return true; }
  std::unique_ptr<Device> make_device() const override { return std::make_unique<SkidSteer>(); }
};

class SkidSteerOdometry : public TrueOdometry {
 public:
  void configure(Params& params, Wiring& wiring) override {
    read_skid(params);
    TrueOdometry::configure(params, wiring);
  }
};

class SkidSteerOdometryPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind =
        odometry_kind("skid_steer_odometry", "Odometry of a skid-steered robot.", 100.0);
    return kind;
  }
  std::optional<std::string> link_of(Params&) const override { return ""; }
  std::unique_ptr<Sensor> make_sensor() const override {
    return std::make_unique<SkidSteerOdometry>();
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::SkidSteerPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::SkidSteerOdometryPlugin)
