// libgazebo_ros_diff_drive.so
#include "plugin/registration.h"
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
  params.text("legacyMode", "", "not used: it swapped the wheels for older robots");
  return s;
}

WheelSettings read_wheels(Params& params) { return read_settings(params); }

Kind diff_drive_kind() {
  return wheels_kind("diff_drive", "Two driven wheels, as Gazebo's robots have.");
}

}  // namespace

using DiffDrivePlugin = WheelsPlugin<read_wheels, diff_drive_kind>;

/// The pose of its base, by the world or by its wheels.
class DiffDriveOdometry : public Sensor {
 public:
  static Kind describe() {
    return odometry_kind("odometry", "Odometry of a differential drive.", 100.0);
  }
  void configure(Params& params, Wiring& wiring) override {
    const Settings s = read_settings(params);
    base_.configure(params, wiring);
    by_wheels_ = s.by_wheels;
    wheels_.set_up(s, wiring);
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    if (by_wheels_) {
      wheels_.read(view, base_, std::nullopt, reading);
    } else {
      base_.read_true(view, reading);
    }
  }

  Nanoseconds idle_until(const Ahead&) const override {
    return (by_wheels_ ? wheels_.rests() : base_.rests()) ? kForever : 0;
  }

 private:
  Base base_;
  bool by_wheels_ = false;
  WheelOdometry wheels_;
};

class DiffDriveOdometryPlugin : public BodySensorPlugin<DiffDriveOdometry> {
 public:
  std::optional<std::string> link_of(Params& params) const override {
    return params.flag("publishTf", true, "odometry is published") ? std::make_optional("")
                                                                   : std::nullopt;
  }
};

/// The angles of its wheels.
class DiffDriveJoints : public JointStates {
 public:
  static Kind describe() {
    return joint_states_kind("wheel_states", "The wheels of a differential drive.");
  }
  void configure(Params& params, Wiring& wiring) override {
    const Settings s = read_settings(params);
    set_up({s.left.front(), s.right.front()}, wiring);
  }
};

class DiffDriveJointsPlugin : public BodySensorPlugin<DiffDriveJoints> {
 public:
  std::optional<std::string> link_of(Params& params) const override {
    return read_settings(params).publishes_joints ? std::make_optional("") : std::nullopt;
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::DiffDrivePlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::DiffDriveOdometryPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::DiffDriveJointsPlugin)
