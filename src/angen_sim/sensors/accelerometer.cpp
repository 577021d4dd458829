// libaccelerometer.so
#include <algorithm>
#include <cmath>

#include "plugin/own_motion.h"
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"

namespace angen::sensors {

namespace {

constexpr double kGentle = 0.3;                      // share of gravity
constexpr double kGlides = 0.05;                     // m/s up or down: uniform motion is not rest
constexpr Nanoseconds kLongestGlide = 10 * kSecond;  // the integral of a longer one says nothing

}  // namespace

/// Proper acceleration where it is fastened, and conclusions: whether it is moved, tilted
/// or lifted. Decisions are made before noise, which is far below their thresholds.
class Accelerometer : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    sample_period_ = read_sample_period(params, 100.0, {1.0, 1e4});
    activity_ = params.number("activity_threshold", 0.5, "m/s^2",
                              "difference of its acceleration from gravity's that counts as motion",
                              kPositive);
    quiet_ = from_seconds(params.number("inactivity_time", 0.5, "s",
                                        "time below the threshold until it is at rest", kPositive));
    tilt_threshold_ =
        params.number("tilt_threshold", 0.35, "rad",
                      "it is tilted beyond this angle from how it was mounted", {1e-3, M_PI});
    lift_threshold_ = params.number("lift_threshold", 0.05, "m",
                                    "a movement that ends higher by this has lifted it, lower "
                                    "has put it down",
                                    kPositive);
    params.noise("acceleration", "m/s^2", "of each axis");
    link_ = wiring.link(params.text("link", "", "the link that it is fastened to"));
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const LinkView link = view.link(link_);
    const Pose pose = view.pose();
    const Vec3 velocity =
        link.linear_velocity + link.angular_velocity.cross(pose.position - link.pose.position);
    const double dt = to_seconds(sample_period_);  // while samples are left out it rests
    if (!link.awake) motion_.forget();
    motion_.note(pose, velocity, dt);
    follow(motion_.acceleration(), dt, view, reading);
    const Vec3 felt = motion_.felt(view.gravity());
    const Vec3 up = pose.rotation.conjugate() * -view.gravity().normalized();
    if (!moving_) note_tilt(std::acos(std::clamp(up.z(), -1.0, 1.0)), reading);
    // In free fall or a jerk the vertical cannot be measured: the tilt stays.
    const double g = view.gravity().norm();
    if (moving_ && std::abs(felt.norm() - g) < kGentle * g) note_tilt(angle_to(felt), reading);
    reading.set("acceleration", std::vector<double>{felt.x(), felt.y(), felt.z()});
    reading.set("tilt", tilt_);
    reading.set("moving", moving_);
    reading.set("tilted", tilted_);
    reading.set("lifted", lifted_);
    reading.set("height", height_);
  }

  Nanoseconds idle_until(const Ahead&) const override { return moving_ ? 0 : kForever; }

 private:
  // rad, of its z axis from the measured acceleration.
  static double angle_to(const Vec3& felt) {
    return felt.isZero(0.0) ? 0.0 : std::acos(std::clamp(felt.normalized().z(), -1.0, 1.0));
  }

  // Integrates the vertical acceleration from rest to rest, as long as a movement lasts.
  void follow(const Vec3& acceleration, double dt, const View& view, Reading& reading) {
    const Nanoseconds now = view.time();
    if (acceleration.norm() > activity_) {
      active_at_ = now;
      if (!moving_) {
        moving_ = true;
        speed_ = rise_ = 0.0;
        reading.announce("moved");
      }
    }
    if (!moving_) return;
    const double up = -acceleration.dot(view.gravity().normalized());
    rise_ += (speed_ + 0.5 * up * dt) * dt;
    speed_ += up * dt;
    const Nanoseconds even = now - active_at_;
    if (even < quiet_ || (std::abs(speed_) > kGlides && even < kLongestGlide)) return;
    moving_ = false;
    height_ += rise_;
    const bool higher = rise_ > lift_threshold_;
    const bool lower = rise_ < -lift_threshold_;
    if (higher || lower) {
      lifted_ = height_ > lift_threshold_;
      reading.announce(higher ? "lifted" : "put_down");
    } else {
      reading.announce("rests");
    }
    if (!lifted_) height_ = 0.0;
  }

  void note_tilt(double tilt, Reading& reading) {
    tilt_ = tilt;
    const bool tilted = tilted_ ? tilt > 0.8 * tilt_threshold_ : tilt > tilt_threshold_;
    if (tilted == tilted_) return;
    tilted_ = tilted;
    reading.announce(tilted ? "tilted" : "upright");
  }

  LinkRef link_;
  Nanoseconds quiet_ = 0;
  double activity_ = 0.0;        // m/s^2
  double tilt_threshold_ = 0.0;  // rad
  double lift_threshold_ = 0.0;  // m

  Nanoseconds active_at_ = 0;
  OwnMotion motion_;
  double speed_ = 0.0;   // m/s upwards, since the movement began
  double rise_ = 0.0;    // m, since then
  double height_ = 0.0;  // m, over where it was put down last
  double tilt_ = 0.0;    // rad
  bool moving_ = false;
  bool tilted_ = false;
  bool lifted_ = false;
};

ANGEN_REGISTER_SENSOR(
    Accelerometer,
    Kind("accelerometer", "Acceleration of a thing that is moved, tilted, lifted, put down.")
        .rate(10.0)
        .sensor_type("imu")
        .example("spawn accelerometer a1 --on kitchen_chair0_a::body --set link=body")
        .numbers("acceleration", "m/s^2", "along its x, y, z; at rest g upwards")
        .shown(2)
        .number("tilt", "rad", "of its z axis from the measured vertical")
        .shown(2)
        .flag("moving", "whether it is moved")
        .alarm("MOVED", "")
        .flag("tilted", "whether it is tilted beyond the threshold")
        .shown_as("tilted", "")
        .flag("lifted", "whether it was lifted and not put down yet")
        .shown_as("lifted", "")
        .number("height", "m", "over where it was put down last, as its integral says"))

}  // namespace angen::sensors
