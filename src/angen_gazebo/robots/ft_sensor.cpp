// libgazebo_ros_ft_sensor.so
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/names.h"

namespace angen::robots {

/// The force of a joint's child on its parent.
class FtSensor : public Sensor {
 public:
  static Kind describe() {
    return Kind("ft_sensor", "Force and torque that a joint carries.")
        .rate(1000.0)
        .on_demand()
        .numbers("force", "N", "that the child gives the parent, x y z of the child's frame")
        .shown(2)
        .numbers("torque", "N m", "the same, about the joint's origin")
        .shown(2)
        .text("frame", "the joint's child link");
  }

  void configure(Params& params, Wiring& wiring) override {
    const std::string name =
        local_name(wiring.model(), params.text("jointName", "", "the joint that it measures"));
    if (name.empty()) throw params.error("jointName", "<jointName> is missing; name a joint");
    joint_ = wiring.joint(name);
    frame_ = wiring.child_of(joint_);
    child_ = wiring.link(frame_);
    read_noise(params, {"force", "torque"});
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const JointWrench wrench = view.wrench(joint_);
    const Quat to_child = view.link(child_).pose.rotation.conjugate();
    reading.set("force", numbers(Vec3(to_child * wrench.force)));
    reading.set("torque", numbers(Vec3(to_child * wrench.torque)));
    reading.set("frame", frame_);
  }

 private:
  JointRef joint_;
  LinkRef child_;
  std::string frame_;
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::FtSensor>)
