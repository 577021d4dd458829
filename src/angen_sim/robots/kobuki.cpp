// libgazebo_ros_kobuki.so
#include <cmath>

#include "plugin/register.h"
#include "robots/joint_states.h"
#include "robots/wheels.h"

namespace angen::robots {

namespace {

constexpr const char* kOdometryFrame = "odom";
constexpr const char* kBaseFrame = "base_footprint";

WheelSettings read_kobuki(Params& params) {
  WheelSettings s;
  s.separation = params.number("wheel_separation", 0.23, "m", "between the wheels", kPositive);
  s.radius = params.number("wheel_diameter", 0.07, "m", "diameter of a wheel", kPositive) / 2.0;
  s.torque = params.number("torque", 1.0, "N m", "greatest torque of a wheel", kPositive);
  s.left = {params.text("left_wheel_joint_name", "wheel_left_joint", "joint of the left wheel")};
  s.right = {
      params.text("right_wheel_joint_name", "wheel_right_joint", "joint of the right wheel")};
  s.timeout = from_seconds(params.number("velocity_command_timeout", 0.6, "s",
                                         "it stops this long after a command", kPositive));
  params.flag("publish_tf", true, "the transform from odometry to base is published");
  for (const char* path : {"cliff_sensor_left_name", "cliff_sensor_center_name",
                           "cliff_sensor_right_name", "cliff_detection_threshold", "bumper_name",
                           "wheel_drop_left_sensor_name", "wheel_drop_right_sensor_name"}) {
    params.text(path, "", "not used: its events are messages of kobuki_msgs");
  }
  params.text("imu_name", "", "not used: its gyro sits in the base");
  return s;
}

Kind kobuki_kind() { return wheels_kind("kobuki", "The Kobuki base of TurtleBot 2."); }

}  // namespace

using KobukiPlugin = WheelsPlugin<read_kobuki, kobuki_kind>;

/// The way by its wheels, the heading by its gyro.
class KobukiOdometry : public Sensor {
 public:
  static Kind describe() {
    return odometry_kind("kobuki_odometry", "Odometry of a Kobuki: wheels and gyro.", 50.0);
  }
  void configure(Params& params, Wiring& wiring) override {
    wheels_.set_up(read_kobuki(params), wiring);
    base_.configure({kOdometryFrame, kBaseFrame});
    link_ = wiring.link("");
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const LinkView link = view.link(link_);
    const double heading = to_rpy(link.pose.rotation).z();
    wheels_.read(view, base_, std::make_pair(heading, link.angular_velocity.z()), reading);
  }
  bool steady() const override { return wheels_.rests(); }

 private:
  Base base_;
  WheelOdometry wheels_;
  LinkRef link_;
};

class KobukiWheels : public JointStates {
 public:
  static Kind describe() { return joint_states_kind("kobuki_wheels", "The wheels of a Kobuki."); }
  void configure(Params& params, Wiring& wiring) override {
    const WheelSettings s = read_kobuki(params);
    set_up({s.left.front(), s.right.front()}, wiring);
  }
};

class KobukiImu : public InertialUnit {
 public:
  static Kind describe() {
    return inertia_kind("kobuki_imu", "Orientation, turning and acceleration of a Kobuki.", 50.0);
  }
  void configure(Params& params, Wiring& wiring) override {
    read_kobuki(params);
    InertialUnit::configure(params, wiring);
    // Its gyro measures the heading alone: of the rest nothing is known.
    const Vec3 deviation(1e3, 1e3, std::sqrt(0.05));
    set_deviations(deviation, deviation, Vec3::Zero());
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::KobukiPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiOdometry>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiWheels>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiImu>)
