#include <algorithm>
#include <cmath>

#include "plugin/register.h"
#include "robots/joint_states.h"
#include "robots/wheels.h"

namespace angen::robots {

namespace {

/// The parameters of the one <plugin>, from which three things are made.
struct Settings : WheelSettings {
  bool by_wheels = false;
  bool publishes_joints = false;
};

Settings read_settings(Params& params) {
  Settings s;
  read_topics(params);
  s.separation = params.number("wheelSeparation", 0.34, "m", "between the wheels", kPositive);
  s.radius = params.number("wheelDiameter", 0.15, "m", "diameter of a wheel", kPositive) / 2.0;
  s.torque = params.number("wheelTorque", 5.0, "N m", "greatest torque of a wheel", kPositive);
  s.acceleration = params.number("wheelAcceleration", 0.0, "m/s^2",
                                 "acceleration at a wheel's rim; 0: at once", kNotNegative);
  s.left = {params.text("leftJoint", "left_joint", "joint of the left wheel")};
  s.right = {params.text("rightJoint", "right_joint", "joint of the right wheel")};
  s.by_wheels = params.choice("odometrySource", "world", {"world", "encoder"},
                              "odometry is the truth, or counted from the wheels") == "encoder";
  s.publishes_joints =
      params.flag("publishWheelJointState", false, "joint_states of the wheels are published");
  params.flag("publishWheelTF", false, "not used: robot_state_publisher has them");
  params.flag("publishOdomTF", true, "the transform from odometry to base is published");
  params.flag("publishTf", true, "odometry is published");
  params.text("legacyMode", "", "not used: it exchanged the wheels of old robots");
  return s;
}

WheelSettings read_wheels(Params& params) { return read_settings(params); }

Kind diff_drive_kind() {
  return wheels_kind("diff_drive", "Two driven wheels, as Gazebo's robots have.");
}

}  // namespace

using DiffDrivePlugin = WheelsPlugin<read_wheels, diff_drive_kind>;

/// Where its base is, as the world or its wheels have it.
class DiffDriveOdometry : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const Settings s = read_settings(params);
    base_.configure(params, wiring);
    by_wheels_ = s.by_wheels;
    separation_ = s.separation;
    radius_ = s.radius;
    left_ = wiring.joint(s.left.front());
    right_ = wiring.joint(s.right.front());
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    if (!by_wheels_) {
      base_.read_true(view, reading);
      return;
    }
    const JointView left = view.joint(left_);
    const JointView right = view.joint(right_);
    if (started_) count(left.position - left_at_, right.position - right_at_);
    started_ = true;
    left_at_ = left.position;
    right_at_ = right.position;
    const double v = (left.velocity + right.velocity) / 2.0 * radius_;
    const double w = (right.velocity - left.velocity) * radius_ / separation_;
    const Quat turned(Eigen::AngleAxisd(yaw_, Vec3::UnitZ()));
    base_.read({at_, turned}, turned * Vec3(v, 0.0, 0.0), w, reading);
    wheels_rest_ = left.velocity == 0.0 && right.velocity == 0.0;
  }

  bool steady() const override { return by_wheels_ ? wheels_rest_ : base_.rests(); }

 private:
  // Turned angles of the wheels since the last sample, each less than half a turn.
  void count(double left, double right) {
    left = std::remainder(left, 2.0 * M_PI) * radius_;
    right = std::remainder(right, 2.0 * M_PI) * radius_;
    const double turn = (right - left) / separation_;
    const double middle = yaw_ + turn / 2.0;
    at_ += (left + right) / 2.0 * Vec3(std::cos(middle), std::sin(middle), 0.0);
    yaw_ = std::remainder(yaw_ + turn, 2.0 * M_PI);
  }

  Base base_;
  bool by_wheels_ = false;
  double separation_ = 0.0;  // m
  double radius_ = 0.0;      // m
  JointRef left_, right_;
  bool started_ = false;
  bool wheels_rest_ = false;
  double left_at_ = 0.0, right_at_ = 0.0;  // rad
  Vec3 at_ = Vec3::Zero();
  double yaw_ = 0.0;
};

class DiffDriveOdometryPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind = odometry_kind("odometry", "Odometry of a differential drive.", 100.0);
    return kind;
  }
  std::optional<std::string> link_of(Params& params) const override {
    return params.flag("publishTf", true, "odometry is published") ? std::make_optional("")
                                                                   : std::nullopt;
  }
  std::unique_ptr<Sensor> make_sensor() const override {
    return std::make_unique<DiffDriveOdometry>();
  }
};

/// The angles of its wheels.
class DiffDriveJoints : public JointStates {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const Settings s = read_settings(params);
    set_up({s.left.front(), s.right.front()}, wiring);
  }
};

class DiffDriveJointsPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind =
        joint_states_kind("wheel_states", "The wheels of a differential drive.");
    return kind;
  }
  std::optional<std::string> link_of(Params& params) const override {
    return read_settings(params).publishes_joints ? std::make_optional("") : std::nullopt;
  }
  std::unique_ptr<Sensor> make_sensor() const override {
    return std::make_unique<DiffDriveJoints>();
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::DiffDrivePlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::DiffDriveOdometryPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::DiffDriveJointsPlugin)
