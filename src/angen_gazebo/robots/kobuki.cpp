// libgazebo_ros_kobuki.so
#include "robots/kobuki.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/joint_states.h"

namespace angen::robots {

KobukiSettings read_kobuki(Params& params) {
  KobukiSettings s;
  s.separation = params.number("wheel_separation", 0.23, "m", "between the wheels", kPositive);
  s.radius = params.number("wheel_diameter", 0.07, "m", "diameter of a wheel", kPositive) / 2.0;
  s.torque = params.number("torque", 1.0, "N m", "greatest torque of a wheel", kPositive);
  s.left = {params.text("left_wheel_joint_name", "wheel_left_joint", "joint of the left wheel")};
  s.right = {
      params.text("right_wheel_joint_name", "wheel_right_joint", "joint of the right wheel")};
  s.timeout = from_seconds(params.number("velocity_command_timeout", 0.6, "s",
                                         "it stops this long after a command", kPositive));
  params.flag("publish_tf", true, "the transform from odometry to base is published");
  for (std::size_t i = 0; i < s.cliffs.size(); ++i) {
    s.cliffs.at(i) = params.text(kCliffNames.at(i), "", "ray sensor that looks at the floor there");
  }
  s.cliff = params.number("cliff_detection_threshold", 0.04, "m",
                          "a floor at this range or farther is a cliff", kPositive);
  for (std::size_t i = 0; i < s.drops.size(); ++i) {
    s.drops.at(i) = params.text(kDropNames.at(i), "", "contact sensor of that wheel");
  }
  s.bumper = params.text(kBumperName, "",
                         "contact sensor that is its bumper; none: all collisions of its base");
  params.text("imu_name", "", "not used: its gyro sits in the base");
  return s;
}

namespace {

constexpr const char* kOdometryFrame = "odom";
constexpr const char* kBaseFrame = "base_footprint";
constexpr const char* kResets = "odometry_resets";

WheelSettings read_wheels(Params& params) { return read_kobuki(params); }

Kind kobuki_kind() {
  Kind kind = wheels_kind("kobuki", "The Kobuki base of TurtleBot 2.");
  kind.verb("MotorsOn", "its motors obey speeds")
      .verb("MotorsOff", "it stops, and ignores speeds")
      .verb("ResetOdometry", "its odometry is zero here");
  kind.flag("motors", "they obey speeds").shown_as("", "motors off");
  return std::move(kind.integer(kResets, "", "how often its odometry was reset"));
}

}  // namespace

/// Its wheels are braked while its motors are off, as in Gazebo.
class Kobuki : public WheelsOf<read_wheels> {
 public:
  Verdict command(const Command& command, const View& view) override {
    if (command.verb == "ResetOdometry") return Verdict::accept([this] { ++resets_; });
    if (command.verb == "MotorsOn") return Verdict::accept([this] { motors_ = true; });
    if (command.verb == "MotorsOff") {
      return Verdict::accept([this] {
        motors_ = false;
        roll(0.0, 0.0, kForever);
      });
    }
    return motors_ ? Wheels::command(command, view) : Verdict::accept();
  }
  void report(const View& view, Reading& state) const override {
    Wheels::report(view, state);
    state.set("motors", motors_);
    state.set(kResets, resets_);
  }

 private:
  bool motors_ = true;
  std::int64_t resets_ = 0;
};

using KobukiPlugin = WheelsPlugin<read_wheels, kobuki_kind, Kobuki>;

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
    model_ = wiring.model();
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    restart_where_reset(view);
    const LinkView link = view.link(link_);
    const double heading = to_rpy(link.pose.rotation).z();
    wheels_.read(view, base_, std::make_pair(heading, link.angular_velocity.z()), reading);
  }
  Nanoseconds idle_until(const Ahead&) const override { return wheels_.rests() ? kForever : 0; }

 private:
  void restart_where_reset(const View& view) {
    for (const DeviceView& device : view.devices(kResets)) {
      if (device.model != model_) continue;
      const auto resets = device.state.get<std::int64_t>(kResets);
      if (resets != resets_) wheels_.restart();
      resets_ = resets;
    }
  }

  Base base_;
  WheelOdometry wheels_;
  LinkRef link_;
  std::string model_;
  std::int64_t resets_ = 0;  // resets of its drive, at the last sample
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
