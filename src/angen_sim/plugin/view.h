#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/contact.h"
#include "core/home.h"
#include "core/pose.h"
#include "core/time.h"
#include "light/probe.h"
#include "plugin/parts.h"
#include "plugin/reading.h"
#include "rays/scene.h"
#include "render/pinhole_camera.h"

namespace angen {

/// Another device as everybody sees it: where it is, and its last state.
struct DeviceView {
  std::string_view kind;
  std::string_view name;
  std::string_view model;
  Pose pose;             // world, of its model
  const Reading& state;  // its stamp is the time of the last change

  /// Where it is (world, m): at the `position` of its state, if that is x y z in its model's frame,
  /// or else at its model's origin.
  Vec3 place() const { return place_of(pose, state); }
  static Vec3 place_of(const Pose& model, const Reading& state) {
    const auto* offset = state.get_if<std::vector<double>>("position");
    const bool is_place = offset != nullptr && offset->size() == 3;  // not, say, that of a joint
    return is_place ? model * Vec3(Vec3::Map(offset->data())) : model.position;
  }
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
  /// The devices whose state has a field of that name and whose place(), or whose model's origin,
  /// is in `within` (world, m), in the order in which they came into the world.
  virtual std::vector<DeviceView> devices(const std::string& field,
                                          const Eigen::AlignedBox3d& within) const = 0;
  /// Devices with that field anywhere in the world.
  std::vector<DeviceView> devices(const std::string& field) const {
    const Vec3 far = Vec3::Constant(std::numeric_limits<double>::infinity());
    return devices(field, {-far, far});
  }
  /// The device of that kind and name, if its state has that field.
  virtual std::optional<DeviceView> device(const std::string& field, const std::string& kind,
                                           const std::string& name) const = 0;
  /// Whether there is one; to a sensor its state does not matter.
  virtual bool has_device(const std::string& field, const std::string& kind,
                          const std::string& name) const = 0;
  /// The home that the world describes. It is valid until the next update or sample.
  virtual const Home& home() const = 0;
  /// All shapes: casts rays, and answers other queries of what is on their way.
  virtual const rays::Scene& rays() const = 0;
  /// The shapes of its own model that rays hit.
  virtual std::vector<std::uint32_t> own_shapes() const = 0;
  /// The name of the model that a shape belongs to.
  virtual std::string model_of(std::uint32_t) const { return ""; }
  /// Light at a place; see light::Lighting::measure. The first query in a world finds the light of
  /// all lit lamps, which takes up to some seconds of CPU time.
  virtual light::Sample illuminance(light::Probe& probe, const Pose& pose) const = 0;
  virtual double ambient_temperature() const = 0;  // K
  /// Shapes whose temperature is known, or changes; others are as warm as the air.
  virtual const std::vector<rays::WarmShape>& warm_shapes() const = 0;
  /// To a sensor that calls it before other queries, only shapes matter that are near the rays that
  /// make() returns (world), up to the static shapes that these hit.
  virtual Revisions watch(const std::function<std::vector<rays::Ray>()>& make) const = 0;
  /// The image of a camera at `pose` (world, x ahead, z up): height x width x 3 bytes, sRGB.
  virtual std::vector<std::uint8_t> colors(const render::PinholeCamera& lens,
                                           const Pose& pose) const = 0;
  /// height x width distances along its x axis in m, NaN if nothing is.
  virtual std::vector<float> depths(const render::PinholeCamera& lens, const Pose& pose) const = 0;
};

}  // namespace angen
