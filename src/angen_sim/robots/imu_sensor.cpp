#include "plugin/register.h"
#include "robots/base.h"

namespace angen::robots {

/// An inertial measurement unit as a <sensor type="imu">.
class ImuSensor : public Sensor {
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
    params.text("bodyName", "", "not used: it sits on the sensor's link");
    params.flag("initialOrientationAsReference", false, "not used: the world is, as REP 145 wants");
    params.rows("xyzOffset", 3, "m", "not used, as in Gazebo");
    params.rows("rpyOffset", 3, "rad", "not used: give the sensor a <pose>");
    inertia_.configure(wiring.link(""), wiring.gravity());
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    inertia_.read(view, reading);
  }
  bool steady() const override { return inertia_.rests(); }

 private:
  Inertia inertia_;
};

class ImuSensorPlugin : public Plugin {
 public:
  const Kind& kind() const override {
    static const Kind kind = inertia_kind(
        "imu_sensor", "Orientation, turning and acceleration of a <sensor type=\"imu\">.", 1.0);
    return kind;
  }
  std::unique_ptr<Sensor> make_sensor() const override { return std::make_unique<ImuSensor>(); }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::ImuSensorPlugin)
