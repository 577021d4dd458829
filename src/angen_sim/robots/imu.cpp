#include "plugin/register.h"
#include "robots/base.h"

namespace angen::robots {

/// An inertial measurement unit on a link, as a model's plug-in.
class Imu : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    const double noise =
        params.number("gaussianNoise", 0.0, "", "standard deviation of each number", kNotNegative);
    for (const char* field : {"angular_velocity", "acceleration"}) {
      Noise each;
      each.field = field;
      each.stddev = noise;
      params.noise(each);
    }
    params.text("serviceName", "", "not used: Gazebo's calibration, which does nothing");
    inertia_.configure(wiring.link(""), wiring.gravity());
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    inertia_.read(view, reading);
  }
  bool steady() const override { return inertia_.rests(); }

 private:
  Inertia inertia_;
};

class ImuPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind =
        inertia_kind("imu", "Orientation, turning and acceleration of a robot's link.", 1000.0);
    return kind;
  }
  std::optional<std::string> link_of(Params& params) const override {
    return params.text("bodyName", "", "the link that it is fastened to");
  }
  std::unique_ptr<Sensor> make_sensor() const override { return std::make_unique<Imu>(); }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::ImuPlugin)
