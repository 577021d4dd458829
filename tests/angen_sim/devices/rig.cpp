#include "angen_sim/devices/rig.h"

#include <limits>
#include <stdexcept>

#include "angen_sim/fakes.h"

namespace angen::test {

Bench::Bench(const desc::Physics& settings) : settings_(settings), world(settings, gravity_, 1) {}

Bench::~Bench() = default;

physics::ModelId Bench::add(const desc::Model& model) {
  const physics::ModelId id = world.add(model);
  show(model, id);
  return id;
}

void Bench::show(const desc::Model& model, physics::ModelId id) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    for (const desc::Collision& c : model.links[i].collisions) {
      shown_.push_back({world.links(id)[i], c.pose,
                        rays_.add(c.shape, c.pose, rays::Mobility::kMoving, {0.5F, 0.5F, 0.5F})});
    }
  }
}

void Bench::cast(const std::vector<rays::Ray>& rays, std::vector<rays::Hit>& hits) {
  for (auto shape = shown_.begin(); shape != shown_.end();) {
    try {
      rays_.move(shape->shape, world.link(shape->link).pose * shape->in_link);
      ++shape;
    } catch (const std::out_of_range&) {  // its model was removed
      rays_.remove(shape->shape);
      shape = shown_.erase(shape);
    }
  }
  rays_.commit();
  rays_.cast(rays, hits);
}

Rig& Bench::add(const desc::Model& model, const std::string& library, const std::string& kind,
                const Parameters& parameters) {
  for (const std::shared_ptr<const Plugin>& plugin : catalog_.library(library)) {
    if (plugin->kind().name != kind) continue;
    rigs_.push_back(std::make_unique<Rig>(*this, model, plugin, parameters));
    return *rigs_.back();
  }
  throw std::runtime_error("no " + kind + " in " + library);
}

void Bench::tick() {
  for (const std::unique_ptr<Rig>& rig : rigs_) rig->update();
  world.step(tick_);
  ++tick_;
}

void Bench::run(double seconds, const std::function<void()>& each) {
  const Nanoseconds end = now() + from_seconds(seconds);
  while (now() < end) {
    tick();
    each();
  }
}

double Bench::run_until(double seconds, const std::function<bool()>& done) {
  const Nanoseconds begin = now();
  while (now() < begin + from_seconds(seconds)) {
    tick();
    if (done()) return to_seconds(now() - begin);
  }
  return -1.0;
}

Vec3 Bench::contact_force(const std::string& one, const std::string& other) const {
  const auto starts = [](const std::string& text, const std::string& with) {
    return text.compare(0, with.size(), with) == 0;
  };
  Vec3 sum = Vec3::Zero();
  for (const ContactPair& pair : world.contacts()) {
    for (const ContactPoint& point : pair.points) {
      if (starts(pair.first, one) && starts(pair.second, other)) sum += point.force;
      if (starts(pair.first, other) && starts(pair.second, one)) sum -= point.force;
    }
  }
  return sum;
}

Rig::Rig(Bench& bench, desc::Model model, std::shared_ptr<const Plugin> plugin,
         const Parameters& parameters)
    : bench_(bench), model_(std::move(model)), model_id_(bench.world.add(model_)) {
  bench_.show(model_, model_id_);
  plugin_ = std::move(plugin);
  device_ = plugin_->make_device();
  Params params(plugin_element(parameters));
  device_->configure(params, *this);
  params.finish();
  warnings = params.warnings();
}

Reading Rig::state() const {
  Reading reading;
  device_->report(*this, reading);
  return reading;
}

Verdict Rig::command(Command command) {
  const std::string wrong = parse_command(plugin_->kind(), command);
  if (!wrong.empty()) return Verdict::reject(wrong);
  Verdict verdict = device_->command(command, *this);
  if (verdict.act) verdict.act();
  return verdict;
}

int Rig::joint_index(const std::string& joint) const {
  for (std::size_t i = 0; i < model_.joints.size(); ++i) {
    if (model_.joints[i].name == joint) return static_cast<int>(i);
  }
  return -1;
}

int Rig::link_index(const std::string& link) const {
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    if (model_.links[i].name == link) return static_cast<int>(i);
  }
  throw Error("no link " + link);
}

physics::JointId Rig::id_of(JointRef joint) const {
  return bench_.world.joints(model_id_).at(static_cast<std::size_t>(joint.index));
}

physics::LinkId Rig::id_of(LinkRef link) const {
  return bench_.world.links(model_id_).at(static_cast<std::size_t>(link.index));
}

JointView Rig::at(const std::string& joint) const {
  return this->joint(JointRef{joint_index(joint)});
}

LinkView Rig::body(const std::string& link) const { return this->link(LinkRef{link_index(link)}); }

JointView Rig::joint(JointRef joint) const {
  const physics::JointState state = bench_.world.joint(id_of(joint));
  return {state.position, state.velocity, state.effort};
}

JointWrench Rig::wrench(JointRef joint) const {
  const physics::Wrench wrench = bench_.world.wrench(id_of(joint));
  return {wrench.force, wrench.torque};
}

LinkView Rig::link(LinkRef link) const {
  const physics::LinkState state = bench_.world.link(id_of(link));
  return {state.pose, state.linear_velocity, state.angular_velocity,
          bench_.world.awake(id_of(link))};
}

bool Rig::has_joint(const std::string& joint) const { return joint_index(joint) >= 0; }

std::vector<std::string> Rig::joint_names() const {
  std::vector<std::string> names;
  for (const desc::Joint& joint : model_.joints) names.push_back(joint.name);
  return names;
}

JointRef Rig::joint(const std::string& joint) {
  if (!has_joint(joint)) throw Error("no joint " + joint);
  return {joint_index(joint)};
}

JointLimits Rig::limits(JointRef joint) const {
  const desc::Joint& described = model_.joints.at(static_cast<std::size_t>(joint.index));
  const desc::JointAxis& axis = described.axes.at(0);
  const desc::Link& child = model_.links.at(static_cast<std::size_t>(link_index(described.child)));
  double inertia = child.inertial.mass;
  if (described.type == desc::Joint::Type::kRevolute) {
    const Pose center = child.pose * child.inertial.pose;
    const Vec3 turned = center.rotation.conjugate() * axis.xyz;
    inertia = turned.dot(child.inertial.moment * turned) +
              inertia * axis.xyz.cross(center.position - described.anchor).squaredNorm();
  }
  const double effort = axis.effort >= 0.0 ? axis.effort : std::numeric_limits<double>::infinity();
  return {axis.lower, axis.upper, axis.damping, axis.friction, inertia, effort};
}

LinkRef Rig::link(const std::string& link) { return {link_index(link)}; }

bool Rig::is_fixed(JointRef joint) const {
  return model_.joints.at(static_cast<std::size_t>(joint.index)).type == desc::Joint::Type::kFixed;
}

std::string Rig::child_of(JointRef joint) const {
  return model_.joints.at(static_cast<std::size_t>(joint.index)).child;
}

Vec3 Rig::anchor(JointRef joint) const {
  return model_.joints.at(static_cast<std::size_t>(joint.index)).anchor;
}

double Rig::mass(LinkRef link) const {
  return model_.links.at(static_cast<std::size_t>(link.index)).inertial.mass;
}

Vec3 Rig::center(LinkRef link) const {
  return model_.links.at(static_cast<std::size_t>(link.index)).inertial.pose.position;
}

LightRef Rig::light(const std::string&) { throw Error("no lights on this bench"); }

ContactRef Rig::collision(const std::string&) { throw Error("no contacts on this bench"); }

void Rig::force(JointRef joint, double force) {
  if (force != 0.0) ++forces;
  ++calls;
  bench_.world.add_force(id_of(joint), force);
}

void Rig::motor(JointRef joint, double velocity, double max_force) {
  ++calls;
  bench_.world.set_motor(id_of(joint), velocity, max_force);
}

void Rig::cast(const std::vector<rays::Ray>& rays, std::vector<rays::Hit>& hits) const {
  bench_.cast(rays, hits);
}

void Rig::latch(JointRef joint, double break_force) {
  ++calls;
  bench_.world.latch(id_of(joint), break_force);
}

void Rig::unlatch(JointRef joint) {
  ++calls;
  bench_.world.unlatch(id_of(joint));
}

void Rig::push(LinkRef link, const Vec3& force, const Vec3& torque, const Vec3& point) {
  ++calls;
  bench_.world.push(id_of(link), force, torque, point);
}

void Rig::drive(LinkRef link, const Vec3& velocity, double yaw_rate, double max_force) {
  ++calls;
  bench_.world.drive(id_of(link), velocity, yaw_rate, max_force);
}

}  // namespace angen::test
