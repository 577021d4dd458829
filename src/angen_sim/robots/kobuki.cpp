// libgazebo_ros_kobuki.so
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

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
                           "cliff_sensor_right_name", "cliff_detection_threshold",
                           "wheel_drop_left_sensor_name", "wheel_drop_right_sensor_name"}) {
    params.text(path, "", "not used: there are no events of it");
  }
  params.text("bumper_name", "", "not used: the collisions of the base are its bumper");
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

/// Three sectors of 60 degrees ahead, pressed where something pushes the base from there.
class KobukiBumper : public Sensor {
 public:
  static Kind describe() {
    Kind kind("kobuki_bumper", "Bumper of a Kobuki: which of its three parts are pressed.");
    for (const char* part : kParts) {
      kind.flag(part, "this part is pressed").shown_as("pressed", "free");
    }
    return std::move(kind.rate(50.0));
  }
  void configure(Params& params, Wiring& wiring) override {
    read_kobuki(params);
    window_ = params.update_period();
    link_ = wiring.link("");
    for (const std::string& name : wiring.collision_names()) {
      collisions_.push_back(wiring.collision(name));
    }
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Pose to_base = view.link(link_).pose.inverse();
    std::array<bool, kParts.size()> pressed{};
    lasting_ = true;
    for (const ContactRef collision : collisions_) {
      const std::vector<ContactPair> pairs = view.contacts_within(collision, window_);
      if (pairs.size() != view.contacts(collision).size()) lasting_ = false;
      for (const ContactPair& pair : pairs) {
        for (const ContactPoint& point : pair.points) {
          if (const auto part = part_at(point, to_base)) pressed.at(*part) = true;
        }
      }
    }
    for (std::size_t i = 0; i < kParts.size(); ++i) reading.set(kParts.at(i), pressed.at(i));
  }
  bool steady() const override { return lasting_; }

 private:
  static constexpr std::array<const char*, 3> kParts{"left", "center", "right"};
  static constexpr double kLowest = 0.01;  // m above the base's origin, as in Gazebo
  static constexpr double kHighest = 0.13;

  // By the direction of the push: a flat wall ahead touches a box at its corners.
  static std::optional<std::size_t> part_at(const ContactPoint& point, const Pose& to_base) {
    const double height = (to_base * point.position).z();
    const Vec3 from = to_base.rotation * -point.normal;
    const bool level = from.head<2>().norm() > std::abs(from.z());
    if (!level || height < kLowest || height > kHighest) return std::nullopt;
    const double bearing = std::atan2(from.y(), from.x());
    if (std::abs(bearing) > M_PI / 2.0) return std::nullopt;
    if (std::abs(bearing) <= M_PI / 6.0) return 1;
    return bearing > 0.0 ? 0 : 2;
  }

  std::vector<ContactRef> collisions_;
  LinkRef link_;
  Nanoseconds window_ = 0;  // contacts that ended before are not reported
  bool lasting_ = true;     // all that it reported last touched then
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::KobukiPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiOdometry>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiWheels>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiImu>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiBumper>)
