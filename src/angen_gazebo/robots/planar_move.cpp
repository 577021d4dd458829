// libgazebo_ros_planar_move.so libhector_gazebo_ros_force_based_move.so
// libgazebo_ros_force_based_move.so libridgeback_ros_force_based_move.so
// librobotnik_force_based_move.so libnexus_ros_force_based_move.so
#include <algorithm>

#include "plugin/outputs.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/base.h"

namespace angen::robots {

namespace {

constexpr double kForcePerMass = 200.0;  // N/kg: it has its speed within some milliseconds

struct Planar {
  double timeout;  // s; negative = never
  Vec3 most;       // m/s, m/s, rad/s; 0 = unlimited
};

Planar read_planar(Params& params) {
  read_topics(params);
  params.number("odometryRate", 20.0, "Hz", "of the odometry", {0.0, 1e6});
  params.flag("publishOdometryTf", true, "the transform from odometry to base is published");
  for (const char* path : {"yaw_velocity_p_gain", "x_velocity_p_gain", "y_velocity_p_gain"}) {
    params.number(path, 0.0, "", "not used: it has its speed within some milliseconds");
  }
  const double timeout =
      params.number("cmdTimeout", -1.0, "s", "it stops this long after a command; -1: never");
  const char* const most = "commands are limited to it; 0: unlimited";
  const double ahead = params.number("max_x_velocity", 0.0, "m/s", most, kNotNegative);
  const double left = params.number("max_y_velocity", 0.0, "m/s", most, kNotNegative);
  const double turn = params.number("max_yaw_velocity", 0.0, "rad/s", most, kNotNegative);
  return {params.number("cmdVelTimeOut", timeout, "s", "the same, as force_based_move calls it"),
          {ahead, left, turn}};
}

double limited(double speed, double most) {
  return most > 0.0 ? std::clamp(speed, -most, most) : speed;
}

}  // namespace

/// A robot that is pushed over the floor as commanded, on wheels or without.
class PlanarMove : public Device {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const Planar planar = read_planar(params);
    timeout_ = planar.timeout < 0.0 ? kForever : from_seconds(planar.timeout);
    most_ = planar.most;
    link_ = wiring.link("");
    force_ = kForcePerMass * wiring.mass(link_);
  }

  Verdict command(const Command& command, const View& view) override {
    return Verdict::accept([this, values = command.values, now = view.time()] {
      velocity_ = {limited(values[0], most_.x()), limited(values[1], most_.y()), 0.0};
      turn_ = limited(values[2], most_.z());
      commanded_at_ = now;
      released_ = false;
    });
  }

  void update(const View& view, Outputs& outputs) override {
    if (released_) return;
    if (view.time() - commanded_at_ >= timeout_) {
      velocity_ = Vec3::Zero();
      turn_ = 0.0;
    }
    const double yaw = to_rpy(view.link(link_).pose.rotation).z();
    outputs.drive(link_, Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * velocity_, turn_, force_);
    released_ = is_stopped();
  }

  Nanoseconds idle_until(const View&) const override { return released_ ? kForever : 0; }

  void report(const View&, Reading& state) const override {
    state.set("forward", velocity_.x());
    state.set("left", velocity_.y());
    state.set("turn", turn_);
  }

 private:
  bool is_stopped() const { return velocity_.isZero(0.0) && turn_ == 0.0; }

  LinkRef link_;
  double force_ = 0.0;        // N
  Vec3 most_ = Vec3::Zero();  // m/s, m/s, rad/s; 0 = unlimited
  Nanoseconds timeout_ = kForever;
  Nanoseconds commanded_at_ = 0;
  Vec3 velocity_ = Vec3::Zero();  // m/s, in its own frame
  double turn_ = 0.0;             // rad/s
  bool released_ = false;         // at rest, held by its brake
};

ANGEN_REGISTER_DEVICE(PlanarMove,
                      Kind("planar_move", "A robot that moves over the floor in any direction.")
                          .verb("Stop", "stops")
                          .value_units({"m/s", "m/s", "rad/s"})
                          .number("forward", "m/s", "as commanded")
                          .shown(2)
                          .number("left", "m/s", "as commanded")
                          .shown(2)
                          .number("turn", "rad/s", "to the left, as commanded")
                          .shown(2))

class PlanarOdometry : public TrueOdometry<Planar, read_planar> {
 public:
  static Kind describe() {
    return odometry_kind("planar_odometry", "Odometry of a robot that moves in any direction.",
                         20.0);
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::PlanarOdometry>)
