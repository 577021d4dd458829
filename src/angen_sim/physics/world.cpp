#include "physics/world.h"

#include <algorithm>
#include <cmath>

#include "core/diagnostics.h"
#include "core/limits.h"
#include "core/lists.h"
#include "core/time.h"
#include "physics/build.h"
#include "physics/drive.h"
#include "physics/impl.h"
#include "physics/joints.h"
#include "physics/sleep.h"

namespace angen::physics {

namespace {

// Least CFM of joints: a brake under 1 kN creeps 1 um/s, and equations stay solvable.
constexpr double kSoftestJoint = 1e-9;
constexpr double kCalmTime = 0.05;  // s

double bounded(double value, const Limit& limit) {
  return std::clamp(value, -limit.most, limit.most);
}

Vec3 bounded(const Vec3& value, const Limit& limit) {
  return value.cwiseMin(limit.most).cwiseMax(-limit.most);
}

bool has_axis(const Joint& joint) {
  return joint.first != nullptr && joint.type != desc::Joint::Type::kBall;
}

}  // namespace

World::Impl::Impl(const desc::Physics& s, const Vec3& g, std::uint64_t seed_)
    : h(to_seconds(s.step)), settings(s), gravity(g), seed(seed_), contacts(s, g) {
  make_ode_world();
}

void World::Impl::make_ode_world() {
  ode::prepare_thread();
  threading.reset(dThreadingAllocateSelfThreadedImplementation());
  world.reset(dWorldCreate());
  dWorldSetStepThreadingImplementation(
      world.get(), dThreadingImplementationGetFunctions(threading.get()), threading.get());
  dWorldSetAutoDisableFlag(world.get(), 0);
  give_settings();
  contacts.use(world.get());
}

void World::Impl::give_settings() {
  dWorldID w = world.get();
  dWorldSetGravity(w, gravity.x(), gravity.y(), gravity.z());
  dWorldSetERP(w, kJointErp);
  dWorldSetCFM(w, std::max(settings.cfm, kSoftestJoint));
  dWorldSetQuickStepNumIterations(w, settings.iterations);
  dWorldSetContactMaxCorrectingVel(w, dInfinity);  // contacts limit it, by their stiffness
  dWorldSetContactSurfaceLayer(w, settings.contact_surface_layer);
}

void World::Impl::wake(Body& body) {
  if (!body.dynamic()) return;
  body.idle_steps = 0;
  wake_up(body, awake);
}

void World::Impl::wake_joint(const Joint& joint) {
  wake(*joint.first);
  wake(*joint.second);
}

void World::Impl::give_to_ode(Body& body) {
  if (body.ode == nullptr) insert(world.get(), *body.mechanism);
}

void World::Impl::wake_near(ModelRecord& model) {
  for (const auto& geom : model.geoms) {
    grid.query(*geom, [&](Geom& other) {
      if (may_touch(*geom, other) && other.body->model != &model) wake(*other.body);
    });
  }
}

void World::Impl::settle(ModelRecord& model, const Pose& pose) {
  configure(world.get(), model, pose);
  for (const auto& geom : model.geoms) grid.update(*geom);
  for (const auto& body : model.bodies) wake(*body);
  wake_near(model);
}

World::World(const desc::Physics& settings, const Vec3& gravity, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(settings, gravity, seed)) {}

World::~World() = default;

ModelId World::add(const desc::Model& model) {
  ode::prepare_thread();
  try {
    return impl_->add(model);
  } catch (const ode::Failure& failure) {
    throw Error(model.source, "model \"" + model.name + "\" cannot be simulated: " +
                                  failure.what() + " (an assertion of ODE)");
  }
}

ModelId World::Impl::add(const desc::Model& model) {
  auto built = build_model(model, shapes, serial);
  ModelRecord& record = *built;
  for (const LinkRecord& link : record.links) {
    record.link_ids.push_back(links.add(link));
    link.body->links.push_back(record.link_ids.back());
  }
  for (const auto& geom : record.geoms) {
    geom->id = collisions.add(geom.get());
    geoms[geom->name] = geom.get();
  }
  for (const auto& joint : record.joints) {
    record.joint_ids.push_back(joints.add(joint.get()));
  }
  const ModelId id = models.add(std::move(built));
  try {
    settle(record, model.pose);
  } catch (const ode::Failure&) {
    remove(id);
    throw;
  }
  return id;
}

void World::remove(ModelId id) { impl_->remove(id); }

void World::Impl::remove(ModelId id) {
  Impl& w = *this;
  ModelRecord& model = *w.models.at(id);
  w.contacts.drop(model, [&](Body& body) { w.wake(body); });
  w.list_is_old = true;
  const auto of_model = [&](const Body* body) { return body->model == &model; };
  erase_if(w.awake, of_model);
  for (const auto& geom : model.geoms) {
    w.grid.erase(*geom);
    w.geoms.erase(geom->name);
    w.collisions.remove(geom->id);
  }
  const auto forget = [&](std::vector<LinkId>& list) {
    const auto gone = [&](LinkId link) { return of_model(w.links.at(link).body); };
    erase_if(list, gone);
  };
  forget(w.moved);
  forget(w.placed);
  for (const LinkId link : model.link_ids) w.links.remove(link);
  for (const JointId joint : model.joint_ids) w.joints.remove(joint);
  w.models.remove(id);
}

const std::vector<LinkId>& World::links(ModelId model) const {
  return impl_->models.at(model)->link_ids;
}

const std::vector<JointId>& World::joints(ModelId model) const {
  return impl_->models.at(model)->joint_ids;
}

LinkState World::link(LinkId id) const {
  const LinkRecord& link = impl_->links.at(id);
  LinkState state;
  state.pose = pose(id);
  state.angular_velocity = link.body->spin();
  state.linear_velocity = link.body->velocity() + state.angular_velocity.cross(
                                                      state.pose.position - link.body->at.position);
  return state;
}

Pose World::pose(LinkId id) const {
  const LinkRecord& link = impl_->links.at(id);
  return link.body->at * link.in_body;
}

double World::mass(LinkId link) const { return impl_->links.at(link).mass; }

bool World::awake(LinkId link) const { return impl_->links.at(link).body->awake; }

void World::wake(LinkId link) { impl_->wake(*impl_->links.at(link).body); }

JointState World::joint(JointId id) const {
  const Joint& joint = impl_->joint_at(id);
  return {joint.position, joint_velocity(joint), joint.effort};
}

Wrench World::wrench(JointId id) const { return joint_wrench(impl_->joint_at(id)); }

void World::add_force(JointId id, double force) {
  Joint& joint = impl_->joint_at(id);
  if (!std::isfinite(force) || !has_axis(joint)) return;
  // A <safety_controller> may make a force of none.
  if (force == 0.0 && !(joint.axes[0].safety && joint.first->awake)) return;
  impl_->wake_joint(joint);
  if (!joint.first->awake) return;  // it has been stopped
  impl_->give_to_ode(*joint.first);
  push_joint(joint, bounded(force, limits::kForce));
}

void World::set_motor(JointId id, double velocity, double max_force) {
  Joint& joint = impl_->joint_at(id);
  if (!has_axis(joint) || !std::isfinite(velocity) || std::isnan(max_force)) return;
  const Axis& axis = joint.axes[0];
  velocity = bounded(velocity, limits::kTurnRate);
  max_force = std::min(max_force, limits::kNoLimit.most);
  if (axis.velocity >= 0.0) velocity = std::clamp(velocity, -axis.velocity, axis.velocity);
  if (axis.effort >= 0.0) max_force = std::min(max_force, axis.effort);
  if (max_force <= 0.0) max_force = velocity = 0.0;
  if (joint.motor_velocity == velocity && joint.motor_force == max_force) return;
  joint.motor_velocity = velocity;
  joint.motor_force = max_force;
  if (joint.main != nullptr) apply_motor(joint);
  impl_->wake_joint(joint);
}

void World::latch(JointId id, double break_force) {
  Joint& joint = impl_->joint_at(id);
  const bool holds =
      joint.type == desc::Joint::Type::kRevolute || joint.type == desc::Joint::Type::kPrismatic;
  if (joint.first == nullptr || !holds || !(break_force > 0.0)) return;
  if (joint.latched && joint.latch_force == break_force) return;
  impl_->wake_joint(joint);
  if (!joint.first->awake) return;  // it has been stopped
  impl_->give_to_ode(*joint.first);
  joint.latched = true;
  joint.latch_broken = false;
  joint.latch_strain = 0.0;
  joint.latch_force = break_force;
  joint.latch_at = ode_position(joint);
  apply_latch(joint);
}

void World::unlatch(JointId id) {
  Joint& joint = impl_->joint_at(id);
  if (!joint.latched) return;
  joint.latched = false;
  if (joint.main != nullptr) apply_latch(joint);
  impl_->wake_joint(joint);
}

void World::drive(LinkId id, const Vec3& velocity, double yaw_rate, double max_force) {
  Body& body = *impl_->links.at(id).body;
  if (!body.dynamic() || !velocity.allFinite() || !std::isfinite(yaw_rate + max_force)) return;
  if (set_drive(impl_->world.get(), body, bounded(velocity, limits::kSpeed),
                bounded(yaw_rate, limits::kTurnRate), std::min(max_force, limits::kForce.most))) {
    impl_->wake(body);
  }
}

void World::push(LinkId id, const Vec3& force, const Vec3& torque, const Vec3& point) {
  Body& body = *impl_->links.at(id).body;
  const bool finite = force.allFinite() && torque.allFinite() && point.allFinite();
  if (!body.dynamic() || !finite || (force.isZero(0.0) && torque.isZero(0.0))) return;
  if (!body.awake) impl_->wake(body);
  if (!body.awake) return;  // it has been stopped
  impl_->give_to_ode(body);
  const Vec3 f = bounded(force, limits::kForce);
  const Vec3 t = bounded(torque, limits::kTorque);
  const Vec3 p = bounded(point, limits::kPosition);
  dBodyAddForceAtPos(body.ode.get(), f.x(), f.y(), f.z(), p.x(), p.y(), p.z());
  dBodyAddTorque(body.ode.get(), t.x(), t.y(), t.z());
}

void World::step(std::int64_t tick, std::int64_t count) { impl_->take_step(tick, count); }

std::int64_t World::longest_step(std::int64_t most) const {
  const int calm_steps = static_cast<int>(std::ceil(kCalmTime / impl_->h));
  for (const Body* body : impl_->awake) {
    const bool led = body->joints.size() == 1 && body->mechanism->bodies.size() == 1;
    const double longest = led ? body->joints.front()->longest_step : 0.0;
    const bool is_calm = body->upright || body->idle_steps >= calm_steps;
    if (body->joints.empty() && is_calm) continue;
    if (longest < static_cast<double>(most) * impl_->h)
      most = static_cast<std::int64_t>(longest / impl_->h);
  }
  return most > 1 && impl_->contacts.allow_long_steps(calm_steps) ? most : 1;
}

const std::vector<Stopped>& World::stopped() const { return impl_->stopped; }

bool World::crowded() const { return impl_->crowded; }

const std::vector<LinkId>& World::moved() const { return impl_->moved; }

const std::vector<ContactPair>& World::contacts() const {
  if (impl_->list_is_old) impl_->listed = impl_->contacts.list();
  impl_->list_is_old = false;
  return impl_->listed;
}

CollisionId World::collision(const std::string& name) const {
  const auto geom = impl_->geoms.find(name);
  return geom == impl_->geoms.end() ? CollisionId{} : geom->second->id;
}

void World::set_touches(CollisionId collision, bool touches) {
  Geom& geom = *impl_->collisions.at(collision);
  if (geom.touches == touches) return;
  geom.touches = touches;
  follow_body(geom);
  impl_->grid.update(geom);
  impl_->wake(*geom.body);
}

std::vector<ContactPair> World::contacts(CollisionId collision) const {
  if (!collision.valid()) return {};
  return impl_->contacts.of(*impl_->collisions.at(collision));
}

std::vector<ContactPair> World::contacts_since(CollisionId collision, std::int64_t first) {
  if (!collision.valid()) return {};
  return Contacts::with_recent(*impl_->collisions.at(collision), first, contacts(collision));
}

std::uint64_t World::contacts_revision(CollisionId collision) const {
  return collision.valid() ? impl_->collisions.at(collision)->contacts_revision : 0;
}

std::uint64_t World::failed_steps() const { return impl_->failed; }

void World::list_awake(std::vector<LinkId>& links) const {
  for (const Body* body : impl_->awake) {
    links.insert(links.end(), body->links.begin(), body->links.end());
  }
}

std::size_t World::awake_count() const { return impl_->awake.size(); }

}  // namespace angen::physics
