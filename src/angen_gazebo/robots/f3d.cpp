// libgazebo_ros_f3d.so
#include "plugin/registration.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "robots/base.h"

namespace angen::robots {

/// The force of all contacts of a link.
class F3d : public Sensor {
 public:
  static Kind describe() {
    return Kind("f3d", "The sum of the contact forces on a link.")
        .rate(1000.0)
        .on_demand()
        .numbers("force", "N", "x y z in the world")
        .shown(2)
        .numbers("torque", "N m", "about x y z of the world, at the link's origin")
        .text("frame", "frame_id of its message");
  }

  void configure(Params& params, Wiring& wiring) override {
    const std::string frame = params.text("frameName", "world", "frame_id of its message");
    frame_ = frame.empty() ? "world" : frame;
    link_ = wiring.link("");
    collisions_ = own_collisions(wiring);
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const Vec3 origin = view.link(link_).pose.position;
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
    for (const ContactRef collision : collisions_) {
      for (const ContactPair& pair : view.contacts(collision)) {
        for (const ContactPoint& point : pair.points) {
          force += point.force;
          torque += (point.position - origin).cross(point.force);
        }
      }
    }
    reading.set("force", numbers(force));
    reading.set("torque", numbers(torque));
    reading.set("frame", frame_);
  }

 private:
  LinkRef link_;
  std::vector<ContactRef> collisions_;
  std::string frame_;
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::BodySensorPlugin<angen::robots::F3d>)
