// libgazebo_ros_bumper.so
#include <optional>
#include <string>

#include "plugin/registration.h"
#include "plugin/touches.h"
#include "plugin/view.h"
#include "plugin/wiring.h"
#include "sensors/debounce.h"
#include "sensors/watched.h"

namespace angen::sensors {

namespace {

void append(std::vector<double>& flat, const Vec3& v) {
  flat.insert(flat.end(), {v.x(), v.y(), v.z()});
}

/// Contact pairs as the flat lists of a reading.
struct Lists {
  std::vector<std::string> collision1, collision2;
  std::vector<double> counts, positions, normals, depths, forces;

  /// `to_frame` is where the world is in the frame of the message.
  void add(const ContactPair& pair, const Pose& to_frame) {
    collision1.push_back(pair.first);
    collision2.push_back(pair.second);
    counts.push_back(static_cast<double>(pair.points.size()));
    for (const ContactPoint& point : pair.points) {
      append(positions, to_frame * point.position);
      append(normals, to_frame.rotation * point.normal);
      depths.push_back(point.depth);
      append(forces, to_frame.rotation * point.force);
    }
  }
};

}  // namespace

/// All bodies that touch some collisions of its link, also sleeping ones, and those that touched
/// them since its last reading.
class Contact : public Sensor {
 public:
  void configure(Params& params, Wiring& wiring) override {
    params.noise("forces", "N", "of each component of a force");
    debounce_.duration = from_seconds(params.number(
        "debounce", 0.0, "s", "least duration of a touch or release that counts", {0.0, 1e6}));
    const Nanoseconds period =
        from_seconds(1.0 / params.number("sample_rate", 100.0, "Hz",
                                         "how often it samples, given a debounce", {1e-3, 1e6}));
    if (debounce_.duration > 0) sample_period_ = period;
    params.text("bumperTopicName", "/angen/contact/NAME", "where it publishes");
    const Nanoseconds window = debounce_.duration == 0 ? params.update_period() : 0;
    read_frame(params, wiring);
    touches_.watch(read_watched(params, wiring, "a contact sensor"), window);
  }

  void read(const View& view, Hits, Rng&, Reading& reading) override {
    const std::vector<ContactPair> pairs = touches_.pairs(view);
    const bool touched = !pairs.empty();
    if (!pressed_) pressed_ = touched;
    if (debounce_.changes(*pressed_, touched, view.time())) {
      pressed_ = touched;
      reading.urgent = debounce_.duration > 0;
      reading.event = touched ? "pressed" : "released";
      if (touched) reading.event_detail = "by " + pairs.front().second;
    }
    const Pose to_frame = frame_link_ ? view.link(*frame_link_).pose.inverse() : Pose{};
    Lists lists;
    for (const ContactPair& pair : pairs) lists.add(pair, to_frame);
    reading.set("pressed", *pressed_);
    reading.set("collision1", std::move(lists.collision1));
    reading.set("collision2", std::move(lists.collision2));
    reading.set("counts", std::move(lists.counts));
    reading.set("positions", std::move(lists.positions));
    reading.set("normals", std::move(lists.normals));
    reading.set("depths", std::move(lists.depths));
    reading.set("forces", std::move(lists.forces));
    reading.set("frame", frame_);
  }

  /// 0 while it waits for the end of a debounce, or has contacts that have ended.
  Nanoseconds idle_until(const Ahead&) const override {
    return !debounce_.waits() && touches_.lasting() ? kForever : 0;
  }

 private:
  // The frame that points and forces are in, where it is a link of the model.
  void read_frame(Params& params, Wiring& wiring) {
    const std::string name = params.text("frameName", "", "link that points and forces are in");
    if (name.empty()) return;
    try {
      frame_link_ = wiring.link(name);
      frame_ = name;
    } catch (const Error&) {
      // It is a frame of others, as "world" or one of a link that was lumped.
    }
  }

  Touches touches_;
  Debounce debounce_;
  std::string frame_ = "world";        // frame of points and forces
  std::optional<LinkRef> frame_link_;  // none: it is the world
  std::optional<bool> pressed_;        // none before the first reading
};

ANGEN_REGISTER_SENSOR(
    Contact,
    Kind("contact", "Contacts of a body: names, points, depths, forces.")
        .rate(1.0)
        .sensor_type("contact")
        .example("spawn contact c1 --on kitchen_chair0_a::body --set collision=seat_collision")
        .flag("pressed", "something touches it, after the debounce")
        .alarm("touched", "free")
        .events("pressed", "released")
        .texts("collision1", "of each contact, the watched collision")
        .texts("collision2", "and the one that touches it")
        .shown()
        .numbers("counts", "", "and how many points it has")
        .numbers("positions", "m", "x y z of each point, in `frame`")
        .numbers("normals", "", "x y z at each point, towards collision1")
        .numbers("depths", "m", "of each point")
        .numbers("forces", "N", "x y z at each point, on collision1")
        .text("frame", "the link that they are in, or world"))

}  // namespace angen::sensors
