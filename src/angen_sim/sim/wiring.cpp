#include "sim/wiring.h"

#include <algorithm>
#include <limits>

#include "core/named.h"
#include "sim/engines.h"
#include "sim/joined.h"

namespace angen::sim {

namespace {

[[noreturn]] void unknown(const std::string& model, const char* what, const std::string& name,
                          const std::vector<std::string>& known) {
  throw Error("model '" + model + "' has no " + what + " '" + name + "'; known are " +
              join_names(known));
}

// Links on fixed joints move as one.
std::vector<const desc::Link*> moving_with(const desc::Model& model, const std::string& link) {
  const std::set<std::string> together = joined_to({link}, model, true, is_fixed);
  std::vector<const desc::Link*> links;
  for (const desc::Link& l : model.links) {
    if (together.count(l.name) != 0) links.push_back(&l);
  }
  return links;
}

// Inertia that a joint moves: kg m^2 about the axis of one that turns, kg along a prismatic one's.
double inertia(const desc::Model& model, const desc::Joint& joint) {
  const bool turns = joint.type != desc::Joint::Type::kPrismatic;
  const Vec3& axis = joint.axes.front().xyz;
  double sum = 0.0;
  for (const desc::Link* link : moving_with(model, joint.child)) {
    const desc::Inertial& inertial = link->inertial;
    const Pose center = link->pose * inertial.pose;
    const Vec3 turned = center.rotation.conjugate() * axis;
    const Vec3 arm = axis.cross(center.position - joint.anchor);
    const double moment = turned.dot(inertial.moment * turned) + inertial.mass * arm.squaredNorm();
    sum += turns ? moment + inertial.mass * joint.lead * joint.lead : inertial.mass;
  }
  return sum;
}

}  // namespace

ModelWiring::ModelWiring(const desc::Model& model, const std::vector<Storey>& storeys,
                         std::string name, std::string sensor_link)
    : model_(model),
      storeys_(storeys),
      name_(std::move(name)),
      sensor_link_(std::move(sensor_link)) {}

std::vector<double> ModelWiring::floors() const {
  std::vector<double> floors;
  const Storey* own = storey_at(storeys_, model_.pose.position.z());
  for (const Storey& storey : storeys_) {
    if (storey.elevation >= own->elevation) floors.push_back(storey.elevation - own->elevation);
  }
  return floors;
}

bool ModelWiring::has_joint(const std::string& joint) const {
  return index_in(model_.joints, joint).has_value();
}

std::vector<std::string> ModelWiring::joint_names() const { return names_in(model_.joints); }

JointRef ModelWiring::joint(const std::string& joint) {
  const auto index = index_in(model_.joints, joint);
  if (!index) unknown(model_.name, "joint", joint, names_in(model_.joints));
  joints_.insert(joint);
  return {static_cast<int>(*index)};
}

JointLimits ModelWiring::limits(JointRef joint) const {
  const desc::Joint& described = at(joint);
  if (described.axes.empty()) return {};
  const desc::JointAxis& axis = described.axes.front();
  const double effort = axis.effort >= 0.0 ? axis.effort : std::numeric_limits<double>::infinity();
  return {axis.lower, axis.upper, axis.damping, axis.friction, inertia(model_, described), effort};
}

LinkRef ModelWiring::link(const std::string& link) {
  const std::string& own = sensor_link_.empty() ? model_.links.front().name : sensor_link_;
  const auto index = index_in(model_.links, link.empty() ? own : link);
  if (!index) unknown(model_.name, "link", link, names_in(model_.links));
  return {static_cast<int>(*index)};
}

bool ModelWiring::is_fixed(JointRef joint) const { return angen::sim::is_fixed(at(joint)); }

std::string ModelWiring::child_of(JointRef joint) const { return at(joint).child; }

Vec3 ModelWiring::anchor(JointRef joint) const { return at(joint).anchor; }

Vec3 ModelWiring::axis(JointRef joint) const { return at(joint).axes.at(0).xyz; }

double ModelWiring::mass(LinkRef link) const {
  const std::string& name = at(link).name;
  double mass = 0.0;
  for (const desc::Link* l : moving_with(model_, name)) mass += l->inertial.mass;
  return mass;
}

Vec3 ModelWiring::center(LinkRef link) const { return at(link).inertial.pose.position; }

LightRef ModelWiring::light(const std::string& light) {
  std::vector<std::string> names;
  for (const desc::Link& link : model_.links) {
    for (const desc::Light& l : link.lights) names.push_back(l.name);
  }
  const int index =
      light.empty() && names.size() == 1
          ? 0
          : static_cast<int>(std::find(names.begin(), names.end(), light) - names.begin());
  if (index == static_cast<int>(names.size())) unknown(model_.name, "light", light, names);
  lights_.insert(index);
  return {index};
}

std::vector<std::string> ModelWiring::collision_names(LinkRef link) const {
  return names_in(at(link).collisions);
}

ContactRef ModelWiring::collision(LinkRef ref, const std::string& collision) {
  const std::size_t scope = collision.rfind("::");
  const std::string local = scope == std::string::npos ? collision : collision.substr(scope + 2);
  const desc::Link& link = at(ref);
  if (!index_in(link.collisions, local)) {
    unknown(model_.name, "collision", collision, names_in(link.collisions));
  }
  collisions_.push_back(model_.name + "::" + link.name + "::" + local);
  return {static_cast<int>(collisions_.size() - 1)};
}

std::optional<SensorPart> ModelWiring::sensor(const std::string& sensor) {
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    const auto index = index_in(model_.links[i].sensors, sensor);
    if (!index) continue;
    sensors_.insert(sensor);
    const desc::Sensor& found = model_.links[i].sensors[*index];
    return SensorPart{{static_cast<int>(i)}, found.pose, found.element};
  }
  return std::nullopt;
}

void ModelWiring::anatomy(LinkRef link, Anatomy anatomy) {
  body_ = {link.index, std::move(anatomy)};
}

void ModelWiring::leads(JointRef joint, double longest_step) {
  led_.emplace_back(joint.index, longest_step);
}

std::vector<SurfaceRef> ModelWiring::surfaces(const std::string& visual) {
  std::vector<SurfaceRef> found;
  std::vector<std::string> known;
  int first = 0;
  for (const desc::Link& link : model_.links) {
    std::set<int> visible;  // to rays
    for (const desc::Collision& collision : link.collisions)
      visible.insert(like_visual(link, collision));
    visible.erase(-1);
    for (const int number : visible) {
      const std::string& name = link.visuals[number].name;
      known.push_back(name);
      if (visual.empty() || visual == name || visual == link.name + "/" + name) {
        found.push_back({first + number});
      }
    }
    first += static_cast<int>(link.visuals.size());
  }
  if (!visual.empty() && found.empty()) {
    unknown(model_.name, "visual with a collision of its name", visual, known);
  }
  return found;
}

}  // namespace angen::sim
