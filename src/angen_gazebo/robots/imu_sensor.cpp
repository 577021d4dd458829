// libgazebo_ros_imu_sensor.so
#include "plugin/registration.h"
#include "robots/base.h"

namespace angen::robots {

/// An inertial measurement unit as a <sensor type="imu">.
class ImuSensor : public InertialUnit {
 public:
  void configure(Params& params, Wiring& wiring) override {
    InertialUnit::configure(params, wiring);
    params.text("bodyName", "", "not used: it sits on the sensor's link");
    params.flag("initialOrientationAsReference", false,
                "not used: the world is, as REP 145 requires");
    params.rows("xyzOffset", 3, "m", "not used, as in Gazebo");
    params.rows("rpyOffset", 3, "rad", "not used: give the sensor a <pose>");
  }
};

ANGEN_REGISTER_SENSOR(
    ImuSensor,
    inertia_kind("imu_sensor", "Orientation, turning and acceleration of a <sensor type=\"imu\">.",
                 1.0))

}  // namespace angen::robots
