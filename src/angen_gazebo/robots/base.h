#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plugin/own_motion.h"
#include "plugin/plugin.h"
#include "plugin/registration.h"

/// Shared parts of plug-ins that robots made for Gazebo carry.
namespace angen::robots {

/// The frames of the odometry of Gazebo's drives.
struct Topics {
  std::string odometry_frame;
  std::string base_frame;
};
Topics read_topics(Params& params);

/// Pose and velocity of a robot's base, which its drive publishes as odometry.
class Base {
 public:
  void configure(Params& params, Wiring& wiring);
  /// For a robot whose parameters do not name its frames; read_true() has no link then.
  void configure(Topics topics) { topics_ = std::move(topics); }
  const Topics& topics() const { return topics_; }
  /// The fields of a reading that odometry is made of, from the pose (world) of the base and its
  /// velocities.
  void read(const Pose& pose, const Vec3& velocity, double yaw_rate, Reading& reading) const;
  /// The fields by the true pose in the world.
  void read_true(const View& view, Reading& reading);
  /// Whether it was at rest at the last read_true().
  bool rests() const { return rests_; }

 private:
  Topics topics_;
  LinkRef link_;
  bool rests_ = false;
};

/// Adds those fields to a kind.
Kind odometry_kind(std::string name, std::string doc, double rate);

/// The true odometry of a drive, whose other parameters `read` reads.
template <class Settings, Settings (*read_settings)(Params&)>
class TrueOdometry : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    read_settings(params);
    base_.configure(params, wiring);
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    base_.read_true(view, reading);
  }
  Nanoseconds idle_until(const Ahead&) const override { return base_.rests() ? kForever : 0; }

 private:
  Base base_;
};

/// The state of a sensor on that link: its own pose and velocity.
LinkView own_state(const View& view, LinkRef link);

/// The measurements of an inertial measurement unit where it is fastened.
class Inertia {
 public:
  /// `link` is its own.
  void configure(LinkRef link) { link_ = link; }
  /// Orientation (world), and angular velocity and proper acceleration along its own axes.
  void read(const View& view, Reading& reading);
  /// Whether it felt no motion at the last sample.
  bool rests() const { return rests_; }

 private:
  LinkRef link_;
  bool rests_ = false;
  OwnMotion motion_;
  Nanoseconds time_ = -1;  // when it sampled last
};

/// Adds these fields to a kind.
Kind inertia_kind(std::string name, std::string doc, double rate);

/// A sensor with these readings; each kind reads its own parameters besides.
class InertialUnit : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override;
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    inertia_.read(view, reading);
    reading.set("variances", variances_);
  }
  Nanoseconds idle_until(const Ahead&) const override { return inertia_.rests() ? kForever : 0; }

 protected:
  /// Errors of the orientation (rad), turn rate (rad/s) and acceleration (m/s^2), about or along x,
  /// y, z.
  void set_deviations(const Vec3& orientation, const Vec3& turning, const Vec3& acceleration);

 private:
  Inertia inertia_;
  std::vector<double> variances_ = std::vector<double>(9, 0.0);
};

/// The plug-in of a sensor class with a static function describe(): its kind. It is in a model,
/// on the link that <bodyName> names.
template <class Type>
class BodySensorPlugin : public Plugin {
 public:
  ANGEN_DESCRIBED_AS(Type::describe())
  std::optional<std::string> link_of(Params& params) const override {
    return params.text("bodyName", "", "the link that it is fastened to; none: the first");
  }
  std::unique_ptr<Sensor> make_sensor(Params&) const override { return std::make_unique<Type>(); }
};

/// The plug-in of a sensor that belongs to the model as a whole.
template <class Type>
class ModelSensorPlugin : public BodySensorPlugin<Type> {
 public:
  std::optional<std::string> link_of(Params&) const override { return ""; }
};

/// Reads <gaussianNoise>, the standard deviation of each number in these fields, and gives them
/// such noise.
double read_noise(Params& params, std::initializer_list<const char*> fields);

/// Numbers of which there may be one for all three axes, as hector's plug-ins take them.
Vec3 three_numbers(Params& params, const char* path, const std::string& unit, const char* doc);

/// Adds normally distributed errors.
Vec3 with_errors(const Vec3& value, const Vec3& stddev, Rng& rng);

/// All collisions of the sensor's own link.
std::vector<ContactRef> own_collisions(Wiring& wiring);

std::vector<double> numbers(const Vec3& v);
std::vector<double> numbers(const Quat& q);  // x, y, z, w

}  // namespace angen::robots
