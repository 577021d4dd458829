// libgazebo_ros_kobuki.so
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/lists.h"
#include "plugin/registration.h"
#include "plugin/touches.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/joint_states.h"
#include "robots/wheels.h"

namespace angen::robots {

namespace {

// Parameters that name its sensors.
constexpr std::array<const char*, 3> kCliffNames{
    "cliff_sensor_left_name", "cliff_sensor_center_name", "cliff_sensor_right_name"};
constexpr std::array<const char*, 2> kDropNames{"wheel_drop_left_sensor_name",
                                                "wheel_drop_right_sensor_name"};
constexpr const char* kBumperName = "bumper_name";

/// The parameters of the one <plugin>, from which its drive and all its sensors are made.
struct KobukiSettings : WheelSettings {
  std::array<std::string, 3> cliffs;  // left, center, right
  double cliff = 0.0;                 // m
  std::array<std::string, 2> drops;   // left, right
  std::string bumper;
};

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

constexpr std::array<const char*, 3> kParts{"left", "center", "right"};
constexpr std::array<const char*, 2> kWheels{"left", "right"};

void warn_missing(Params& params, const char* path, const char* what, const std::string& name) {
  params.warn(path, "<" + std::string(path) + "> is '" + name + "', but the model has no " + what +
                        " sensor of that name");
}

/// The collisions of the contact sensor that the parameter names; warns of a name that the model's
/// contact sensors do not have.
std::vector<ContactRef> watched_by(const char* path, const std::string& name, Params& params,
                                   Wiring& wiring) {
  std::vector<ContactRef> collisions;
  const std::optional<SensorPart> sensor = wiring.sensor(name);
  const Element* contact = sensor ? sensor->element.child("contact") : nullptr;
  if (contact == nullptr) {
    if (!name.empty()) warn_missing(params, path, "contact", name);
    return collisions;
  }
  for (const Element& child : contact->children) {
    if (child.name != "collision") continue;
    try {
      collisions.push_back(wiring.collision(sensor->link, child.text));
    } catch (const Error& unknown) {
      params.warn(path, "sensor '" + name + "': " + unknown.diagnostics().front().message);
    }
  }
  return collisions;
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
    const KobukiSettings s = read_kobuki(params);
    link_ = wiring.link("");
    const Nanoseconds window = params.update_period();
    const std::vector<ContactRef> named = watched_by(kBumperName, s.bumper, params, wiring);
    touch_.watch(named.empty() ? own_collisions(wiring) : named, window);
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Pose to_base = view.link(link_).pose.inverse();
    std::array<bool, kParts.size()> pressed{};
    for (const ContactPair& pair : touch_.pairs(view)) {
      for (const ContactPoint& point : pair.points) {
        if (const auto part = part_at(point, to_base)) pressed.at(*part) = true;
      }
    }
    for (std::size_t i = 0; i < kParts.size(); ++i) reading.set(kParts.at(i), pressed.at(i));
  }
  Nanoseconds idle_until(const Ahead&) const override { return touch_.lasting() ? kForever : 0; }

 private:
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

  Touches touch_;
  LinkRef link_;
};

/// The wheels hang down where they touch nothing.
class KobukiWheelDrop : public Sensor {
 public:
  static Kind describe() {
    Kind kind("kobuki_wheel_drop", "Wheel drop switches of a Kobuki: which wheels hang.");
    for (const char* wheel : kWheels) {
      kind.flag(wheel, "this wheel has a contact sensor, and touches nothing")
          .shown_as("dropped", "raised");
    }
    return std::move(kind.rate(50.0));
  }
  void configure(Params& params, Wiring& wiring) override {
    const KobukiSettings s = read_kobuki(params);
    for (std::size_t i = 0; i < kWheels.size(); ++i) {
      const Nanoseconds window = params.update_period();
      touches_.at(i).watch(watched_by(kDropNames.at(i), s.drops.at(i), params, wiring), window);
    }
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    for (std::size_t i = 0; i < kWheels.size(); ++i) {
      Touches& touch = touches_.at(i);
      reading.set(kWheels.at(i), touch.any() && touch.pairs(view).empty());
    }
  }
  Nanoseconds idle_until(const Ahead&) const override {
    return touches_[0].lasting() && touches_[1].lasting() ? kForever : 0;
  }

 private:
  std::array<Touches, kWheels.size()> touches_;
};

/// Looks at the floor along the first ray of each of three ray sensors, as Gazebo's plug-in does.
/// A Kobuki's sit inside its base, so its own shapes do not count.
class KobukiCliff : public Sensor {
 public:
  static Kind describe() {
    Kind kind("kobuki_cliff", "Cliff sensors of a Kobuki: which of its three see no floor.");
    for (const char* part : kParts) {
      kind.flag(part, "its floor is at the threshold or farther").shown_as("cliff", "floor");
    }
    kind.numbers("ranges", "m",
                 "to the floor: left, center, right; infinite out of reach, 0 without a sensor");
    return std::move(kind.rate(50.0));
  }
  void configure(Params& params, Wiring& wiring) override {
    const KobukiSettings s = read_kobuki(params);
    threshold_ = s.cliff;
    for (std::size_t i = 0; i < kParts.size(); ++i) {
      const std::optional<SensorPart> sensor = wiring.sensor(s.cliffs.at(i));
      if (sensor && sensor->element.child("ray") != nullptr) {
        eyes_.push_back(eye_of(*sensor, i));
        if (sensor->link.index != wiring.link("").index) fixed_ = false;
      } else if (!s.cliffs.at(i).empty()) {
        warn_missing(params, kCliffNames.at(i), "ray", s.cliffs.at(i));
      }
    }
  }
  int ray_set(const View&) override { return fixed_ && !eyes_.empty() ? 0 : kNoRaySet; }

  /// Two for each: to where it leaves the robot, and on from there.
  void aim(const View& view, RayBatch& rays) override {
    if (eyes_.empty()) return;
    own_ = view.own_shapes();
    for (const Eye& eye : eyes_) {
      const Pose pose = view.link(eye.link).pose * eye.pose;
      rays::Ray ray{pose.position, (pose.rotation * eye.direction).normalized(), 0.0, eye.reach};
      const double outside = way_out(view, ray);
      rays.push_back({ray.origin, ray.direction, 0.0, outside});
      ray.min = outside;
      rays.push_back(ray);
    }
  }

  void read(const View&, Hits hits, Rng&, Reading& reading) override {
    std::vector<double> ranges(kParts.size(), 0.0);
    for (std::size_t i = 0; i < eyes_.size(); ++i) {
      const rays::Hit& within = hits[2 * i];
      const bool is_floor = within.hit() && !is_own(within.shape);
      ranges.at(eyes_[i].part) = is_floor ? within.range : hits[2 * i + 1].range;
    }
    for (std::size_t i = 0; i < kParts.size(); ++i) {
      reading.set(kParts.at(i), ranges[i] >= threshold_);
    }
    reading.set("ranges", std::move(ranges));
  }
  Nanoseconds idle_until(const Ahead&) const override { return kForever; }

 private:
  struct Eye {
    std::size_t part = 0;
    LinkRef link;
    Pose pose;  // on that link
    Vec3 direction;
    double reach = 0.0;  // m
  };

  static Eye eye_of(const SensorPart& sensor, std::size_t part) {
    RayGeometry fallback;
    fallback.max = 10.0;
    Params params(Element{}, &sensor.element);
    const RayGeometry rays = read_rays(params, fallback);
    return {part, sensor.link, sensor.pose, rays.directions().front(), rays.max};
  }

  // How far along the ray the last of its own shapes is, m.
  double way_out(const View& view, rays::Ray ray) const {
    constexpr double kStep = 1e-4;  // m, past a surface
    for (const std::uint32_t shape : own_) {
      rays::Hit hit;
      while ((hit = view.rays().cast_at(shape, ray)).hit()) ray.min = hit.range + kStep;
    }
    return ray.min;
  }
  bool is_own(std::uint32_t shape) const { return is_in(shape, own_); }

  double threshold_ = 0.0;  // m
  std::vector<Eye> eyes_;
  bool fixed_ = true;  // to its link
  std::vector<std::uint32_t> own_;
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::KobukiPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiOdometry>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiWheels>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiImu>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiBumper>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiWheelDrop>)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::KobukiCliff>)
