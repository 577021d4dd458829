// libgazebo_ros_p3d.so
#include "plugin/registration.h"
#include "plugin/wiring.h"
#include "robots/base.h"

namespace angen::robots {

/// The true pose and velocity of a link in the world.
class P3d : public Sensor {
 public:
  static Kind describe() {
    return Kind("p3d", "Where a link truly is in the world.")
        .rate(1000.0)
        .on_demand()
        .numbers("position", "m", "x y z")
        .shown(2)
        .numbers("orientation", "", "quaternion x y z w")
        .numbers("velocity", "m/s", "x y z")
        .numbers("angular_velocity", "rad/s", "about x, y, z");
  }
  void configure(Params& params, Wiring& wiring) override {
    read_noise(params, {"position", "velocity", "angular_velocity"});
    link_ = wiring.link("");
  }
  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const LinkView own = own_state(view, link_);
    reading.set("position", numbers(own.pose.position));
    reading.set("orientation", numbers(own.pose.rotation));
    reading.set("velocity", numbers(own.linear_velocity));
    reading.set("angular_velocity", numbers(own.angular_velocity));
    rests_ = own.linear_velocity.isZero(0.0) && own.angular_velocity.isZero(0.0);
  }
  Nanoseconds idle_until(const Ahead&) const override { return rests_ ? kForever : 0; }

 private:
  LinkRef link_;
  bool rests_ = false;
};

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::BodySensorPlugin<angen::robots::P3d>)
