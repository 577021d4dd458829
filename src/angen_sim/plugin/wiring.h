#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/anatomy.h"
#include "core/element.h"
#include "core/home.h"
#include "core/pose.h"
#include "plugin/parts.h"

namespace angen {

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
  virtual std::string name() const = 0;   // the instance: "bathroom1"
  virtual std::string model() const = 0;  // the model that it belongs to
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
  /// The <sensor> of that name, also of another link, to measure in its place: it needs no
  /// plug-in of its own then. None if the model has no such sensor.
  virtual std::optional<SensorPart> sensor(const std::string& sensor) = 0;
  /// The visuals of that name ("" = all, also as LINK/VISUAL) that a collision has its surface
  /// from; rays hit no others. Throws Error if a name has none.
  virtual std::vector<SurfaceRef> surfaces(const std::string& visual) = 0;
  /// Properties of a living body that the plug-in moves. The names are those of visuals and
  /// collisions of the link; a name that the model does not have is without effect.
  virtual void anatomy(LinkRef, Anatomy) {}
  /// The plug-in leads this joint, and can do so in steps of up to that many seconds: see
  /// Device::takes_long_steps().
  virtual void leads(JointRef, double) {}
};

}  // namespace angen
