#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact.h"
#include "core/element.h"
#include "core/home.h"
#include "core/pose.h"
#include "core/time.h"
#include "core/warming.h"
#include "light/probe.h"
#include "plugin/reading.h"
#include "rays/scene.h"
#include "render/pinhole_camera.h"

namespace angen {

/// Handles that Wiring gives at configuration; indices into the requests of this instance.
struct JointRef {
  int index = -1;
};
struct LinkRef {
  int index = -1;
};
struct LightRef {
  int index = -1;
};
struct ContactRef {
  int index = -1;
};
struct SurfaceRef {
  int index = -1;
};

struct JointView {
  double position = 0.0;  // rad or m
  double velocity = 0.0;
  double effort = 0.0;  // N m or N that joint and motor gave along the axis in the last step
};
struct LinkView {
  Pose pose;  // world
  Vec3 linear_velocity = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  bool awake = false;
};
/// Wrench of a joint's child on its parent, in the last step, with motor and with all that is
/// applied to the joint.
struct JointWrench {
  Vec3 force = Vec3::Zero();   // N, world axes
  Vec3 torque = Vec3::Zero();  // N m, world axes, about the joint's anchor
};
/// The stops of a joint, and the resistance to its motion.
struct JointLimits {
  double lower = 0.0;
  double upper = 0.0;
  double damping = 0.0;   // N m s/rad or N s/m
  double friction = 0.0;  // N m or N
  double inertia = 0.0;   // kg m^2 about the axis, or kg: of the child and all that is fixed to it
  double effort = std::numeric_limits<double>::infinity();  // N m or N, most that a motor gives
};

/// Another device as everybody sees it: where it is, and its last state.
struct DeviceView {
  std::string_view kind;
  std::string_view name;
  std::string_view model;
  Pose pose;             // world, of its model
  const Reading& state;  // its stamp is the time of the last change
};

/// Queries of the running world. Times are the tick's, never the wall clock's.
class View {
 public:
  virtual ~View() = default;
  virtual Nanoseconds time() const = 0;
  virtual Nanoseconds step() const = 0;
  virtual Vec3 gravity() const = 0;  // m/s^2
  virtual Pose pose() const = 0;     // world; of the sensor, or of the device's model
  virtual JointView joint(JointRef joint) const = 0;
  virtual JointWrench wrench(JointRef joint) const = 0;
  virtual LinkView link(LinkRef link) const = 0;
  /// Pairs that the wired collision takes part in; it is `first` in each.
  virtual std::vector<ContactPair> contacts(ContactRef collision) const = 0;
  /// Contacts now, and the last ones of those that touched at any time in the last `period` (ns).
  virtual std::vector<ContactPair> contacts_within(ContactRef collision,
                                                   Nanoseconds period) const = 0;
  /// The devices whose state has a field of that name and whose models stand in `within` (world,
  /// m), in the order in which they came into the world.
  virtual std::vector<DeviceView> devices(const std::string& field,
                                          const Eigen::AlignedBox3d& within) const = 0;
  /// Devices with that field anywhere in the world.
  std::vector<DeviceView> devices(const std::string& field) const {
    const Vec3 far = Vec3::Constant(std::numeric_limits<double>::infinity());
    return devices(field, {-far, far});
  }
  /// The home that the world describes. It is valid until the next update or sample.
  virtual const Home& home() const = 0;
  /// Nearest hits on shapes of these mobilities: hits[i] answers rays[i].
  virtual void cast(const std::vector<rays::Ray>& rays, std::vector<rays::Hit>& hits,
                    rays::Mobilities among) const = 0;
  void cast(const std::vector<rays::Ray>& rays, std::vector<rays::Hit>& hits) const {
    cast(rays, hits, rays::kAll);
  }
  /// The nearest hit on this shape, as if there were no others.
  virtual rays::Hit cast_at(std::uint32_t shape, const rays::Ray& ray) const = 0;
  /// The shapes of its own model that rays hit.
  virtual std::vector<std::uint32_t> own_shapes() const = 0;
  /// For many rays from one point (world, m) to one shape; see rays::Scene::shaft.
  virtual rays::Shaft shaft(const Vec3& from, double near, std::uint32_t shape) const = 0;
  /// The albedo, r g b, 0 to 1, of a shape that a ray hit.
  virtual Eigen::Vector3f reflectance(std::uint32_t shape) const = 0;
  /// Light at a place; see light::Lighting::measure. The first query in a world finds the light of
  /// all lit lamps, which takes up to some seconds of CPU time: expect_light(), some seconds
  /// before, spreads that over ticks, as light that changes later is.
  virtual light::Sample illuminance(light::Probe& probe, const Pose& pose) const = 0;
  virtual void expect_light(light::Probe& probe, const Pose& pose) const = 0;
  virtual double ambient_temperature() const = 0;  // K
  /// Shapes that are warmer or colder than the air now.
  virtual const std::vector<rays::WarmShape>& warm_shapes() const = 0;
  /// Grows when shapes come, go or move: where it is the same, rays get the same answers.
  virtual std::uint64_t scene_revision() const = 0;
  /// To a sensor that calls it before those two, only shapes near some rays matter: those that
  /// make() returns (world), where they run between static shapes.
  virtual void watch(const std::function<std::vector<rays::Ray>()>& make) const {
    static_cast<void>(make);
  }
  /// How the temperature of one of them changes from now on, until surfaces_set() grows.
  virtual Warming warming(const rays::WarmShape& shape) const = 0;
  /// Grows when one of them begins to change, or changes at once.
  virtual std::uint64_t surfaces_set() const = 0;
  /// The shapes of these mobilities on the segment between two points (world, m), in the order in
  /// which it enters them.
  virtual std::vector<rays::Crossing> crossings(const Vec3& from, const Vec3& to,
                                                rays::Mobilities among) const = 0;
  std::vector<rays::Crossing> crossings(const Vec3& from, const Vec3& to) const {
    return crossings(from, to, rays::kAll);
  }
  /// Box (m, world) around all static shapes except planes.
  virtual Eigen::AlignedBox3d static_bounds() const = 0;
  /// Grows when static shapes come, go or are placed elsewhere.
  virtual std::uint64_t static_revision() const = 0;
  /// The image of a camera at `pose` (world, x ahead, z up): height x width x 3 bytes, sRGB.
  virtual std::vector<std::uint8_t> colors(const render::PinholeCamera& lens,
                                           const Pose& pose) const = 0;
  /// height x width distances along its x axis in m, NaN where nothing is.
  virtual std::vector<float> depths(const render::PinholeCamera& lens, const Pose& pose) const = 0;
};

/// A <sensor> of a model as its file has it.
struct SensorPart {
  LinkRef link;
  Pose pose;  // in the frame of that link
  Element element;
};

/// Finds parts of a model by name, once, before the world runs. Unknown names throw Error and list
/// the known ones.
class Wiring {
 public:
  virtual ~Wiring() = default;
  virtual std::string name() const = 0;   // of this instance: "bathroom1"
  virtual std::string model() const = 0;  // of the model it belongs to
  /// The rooms that its model describes, in the model's frame; names and storeys are not known yet.
  virtual std::vector<Room> rooms() const = 0;
  /// m from the storey of its model up to this one and those above it; none in a world without
  /// storeys.
  virtual std::vector<double> floors() const = 0;
  virtual bool has_joint(const std::string& joint) const = 0;
  virtual std::vector<std::string> joint_names() const = 0;
  virtual JointRef joint(const std::string& joint) = 0;
  virtual JointLimits limits(JointRef joint) const = 0;
  virtual LinkRef link(const std::string& link) = 0;       // "" = the sensor's, or the first
  virtual bool is_fixed(JointRef joint) const = 0;         // its links are one body
  virtual std::string child_of(JointRef joint) const = 0;  // name of the link it moves
  virtual Vec3 anchor(JointRef joint) const = 0;           // m, in the model's frame
  virtual Vec3 axis(JointRef joint) const = 0;             // unit, the first, in that frame
  virtual double mass(LinkRef link) const = 0;             // kg
  virtual Vec3 center(LinkRef link) const = 0;             // m, of its mass, in its own frame
  virtual LightRef light(const std::string& light) = 0;    // "" = the model's only one
  virtual std::vector<std::string> collision_names(LinkRef link) const = 0;
  std::vector<std::string> collision_names() { return collision_names(link("")); }
  virtual ContactRef collision(LinkRef link, const std::string& collision) = 0;
  ContactRef collision(const std::string& name) { return collision(link(""), name); }
  /// The <sensor> of that name, also of another link, to measure in its place: it needs no plug-in
  /// of its own then. None where the model has no such sensor.
  virtual std::optional<SensorPart> sensor(const std::string& sensor) = 0;
  /// The visuals of that name ("" = all, also as LINK/VISUAL) that a collision has its surface
  /// from; rays hit no others. Throws Error where a name has none.
  virtual std::vector<SurfaceRef> surfaces(const std::string& visual) = 0;
};

/// Effects of a device on the world in one tick.
class Outputs {
 public:
  virtual ~Outputs() = default;
  /// N m or N, for this tick only; wakes the bodies unless 0.
  virtual void force(JointRef joint, double force) = 0;
  /// Velocity motor with a force limit, until changed. Velocity 0 is a brake; max_force 0 frees.
  virtual void motor(JointRef joint, double velocity, double max_force) = 0;
  /// Holds a joint where it is against less than `break_force` (N m or N, may be infinite), until
  /// unlatch().
  virtual void latch(JointRef joint, double break_force) = 0;
  virtual void unlatch(JointRef joint) = 0;
  /// Horizontal velocity (m/s) and yaw rate (rad/s) by a motor of at most max_force (N).
  virtual void drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) = 0;
  /// A force (N) at a point (world, m) and a torque (N m) on a link, for this tick only. Wakes a
  /// sleeping body unless both are 0; an awake one may fall asleep under the same push.
  virtual void push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) = 0;
  /// Light level 0..1 and the flux in lm at level 1.
  virtual void light(LightRef light, double level, double luminous_flux) = 0;
  /// Temperature (K) of a surface, as PIRs see it: from `now` it approaches `limit` exponentially,
  /// with a time constant in s (0 = it is there at once). Holds until it is set again.
  virtual void temperature(SurfaceRef surface, double now, double limit, double time_constant) = 0;
  /// Commands another device of this world, as a hand on it does. It is executed at the end of this
  /// tick's updates; a rejection is an event.
  virtual void command(const std::string& kind, const std::string& name,
                       const std::string& text) = 0;
  /// Published on /angen/events.
  virtual void event(const std::string& event, const std::string& detail) = 0;
};

/// Rays that a sensor casts, in the world frame.
using RayBatch = std::vector<rays::Ray>;

/// Answers to a sensor's rays, in their order.
struct Hits {
  const rays::Hit* data = nullptr;
  std::size_t count = 0;

  const rays::Hit& operator[](std::size_t i) const { return data[i]; }
  std::size_t size() const { return count; }
  const rays::Hit* begin() const { return data; }
  const rays::Hit* end() const { return data + count; }
};

}  // namespace angen
