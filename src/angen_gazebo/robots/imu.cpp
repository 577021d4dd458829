// libgazebo_ros_imu.so
#include "plugin/registration.h"
#include "robots/base.h"

namespace angen::robots {

/// An inertial measurement unit as a plug-in of a model.
class Imu : public InertialUnit {
 public:
  static Kind describe() {
    return inertia_kind("imu", "Orientation, turning and acceleration of a robot's link.", 1000.0);
  }
  void configure(Params& params, Wiring& wiring) override {
    InertialUnit::configure(params, wiring);
    params.text("serviceName", "", "not used: Gazebo's calibration, which does nothing");
  }
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::BodySensorPlugin<angen::robots::Imu>)
