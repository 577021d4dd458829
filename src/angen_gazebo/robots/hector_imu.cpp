// libhector_gazebo_ros_imu.so
#include "plugin/registration.h"
#include "robots/base.h"

namespace angen::robots {

/// The inertial measurement unit of hector_gazebo_plugins.
class HectorImu : public InertialUnit {
 public:
  static Kind describe() {
    return inertia_kind("hector_imu", "Orientation, turning and acceleration, as hector's has it.",
                        1000.0);
  }
  void configure(Params& params, Wiring& wiring) override {
    InertialUnit::configure(params, wiring);
    acceleration_error_ = three_numbers(params, "accelGaussianNoise", "m/s^2",
                                        "standard deviation of the acceleration");
    turn_error_ =
        three_numbers(params, "rateGaussianNoise", "rad/s", "standard deviation of the turning");
    heading_error_ = params.number("yawGaussianNoise", 0.0, "rad",
                                   "standard deviation of the heading", kNotNegative);
    set_deviations(heading_error_ * Vec3::UnitZ(), turn_error_, acceleration_error_);
    params.text("frameId", "", "frame_id of its messages; none: bodyName");
    for (const char* path :
         {"accelDrift", "accelDriftFrequency", "accelOffset", "accelScaleError", "rateDrift",
          "rateDriftFrequency", "rateOffset", "rateScaleError", "yawDrift", "yawDriftFrequency",
          "yawOffset", "yawScaleError", "biasTopicName", "serviceName"}) {
      params.text(path, "", "not used: its errors are those of the noise");
    }
    for (const char* path : {"headingDrift", "headingGaussianNoise"}) {
      params.text(path, "", "not used, as in hector's: it reads those of the yaw");
    }
  }
  void read(const View& view, Hits hits, Rng& rng, Reading& reading) override {
    InertialUnit::read(view, hits, rng, reading);
    add_errors("acceleration", acceleration_error_, rng, reading);
    add_errors("angular_velocity", turn_error_, rng, reading);
    if (heading_error_ <= 0.0) return;
    double error = 0.0;
    rng.gaussians(&error, 1);
    const auto q = reading.get<std::vector<double>>("orientation");
    const Quat turned(Eigen::AngleAxisd(heading_error_ * error, Vec3::UnitZ()) *
                      Quat(q[3], q[0], q[1], q[2]));
    reading.set("orientation", numbers(turned));
  }

 private:
  static void add_errors(const char* field, const Vec3& stddev, Rng& rng, Reading& reading) {
    const auto v = reading.get<std::vector<double>>(field);
    reading.set(field, numbers(with_errors({v[0], v[1], v[2]}, stddev, rng)));
  }

  Vec3 acceleration_error_ = Vec3::Zero();
  Vec3 turn_error_ = Vec3::Zero();
  double heading_error_ = 0.0;
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::BodySensorPlugin<angen::robots::HectorImu>)
