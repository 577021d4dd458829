#include "angen_sim/devices/rig.h"

#include <limits>
#include <stdexcept>

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

void Bench::move_shapes() {
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
}

const rays::Scene& Bench::rays() {
  move_shapes();
  return rays_;
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

/// The stops of the joint, and the masses that it moves.
JointLimits limits_of(const desc::Joint& joint, const desc::Link& child) {
  const desc::JointAxis& axis = joint.axes.at(0);
  double inertia = child.inertial.mass;
  if (joint.type == desc::Joint::Type::kRevolute) {
    const Pose center = child.pose * child.inertial.pose;
    const Vec3 turned = center.rotation.conjugate() * axis.xyz;
    inertia = turned.dot(child.inertial.moment * turned) +
              inertia * axis.xyz.cross(center.position - joint.anchor).squaredNorm();
  }
  const double effort = axis.effort >= 0.0 ? axis.effort : std::numeric_limits<double>::infinity();
  return {axis.lower, axis.upper, axis.damping, axis.friction, inertia, effort};
}

Rig::Rig(Bench& bench, const desc::Model& model, std::shared_ptr<const Plugin> plugin,
         const Parameters& parameters)
    : bench_(bench), model_id_(bench.world.add(model)), plugin_(std::move(plugin)) {
  bench_.show(model, model_id_);
  describe(model);
  device_ = plugin_->make_device();
  Params params(plugin_element(parameters));
  device_->configure(params, *this);
  params.finish();
  warnings = params.warnings();
}

void Rig::describe(const desc::Model& model) {
  instance = model_name = model.name;
  FakeWorld::at = model.pose;
  dt = bench_.step();
  gravity_vector = bench_.gravity();
  for (const desc::Link& link : model.links) {
    FakeLink fake;
    fake.mass = link.inertial.mass;
    fake.center = link.inertial.pose.position;
    links.emplace_back(link.name, fake);
  }
  for (const desc::Joint& joint : model.joints) {
    FakeJoint fake;
    fake.fixed = joint.type == desc::Joint::Type::kFixed;
    fake.child = joint.child;
    fake.anchor = joint.anchor;
    if (!joint.axes.empty()) {
      fake.axis = joint.axes[0].xyz;
      fake.limits = limits_of(joint, model.links.at(index(links, joint.child)));
    }
    joints.emplace_back(joint.name, fake);
  }
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

physics::JointId Rig::id_of(JointRef joint) const {
  return bench_.world.joints(model_id_).at(static_cast<std::size_t>(joint.index));
}

physics::LinkId Rig::id_of(LinkRef link) const {
  return bench_.world.links(model_id_).at(static_cast<std::size_t>(link.index));
}

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

void Rig::force(JointRef joint, double force) {
  if (force != 0.0) ++forces;
  ++calls;
  bench_.world.add_force(id_of(joint), force);
}

void Rig::motor(JointRef joint, double velocity, double max_force) {
  ++calls;
  bench_.world.set_motor(id_of(joint), velocity, max_force);
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
