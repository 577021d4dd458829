#include "physics/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/time.h"
#include "physics/reduce.h"
#include "physics/touching.h"

namespace angen::physics {

namespace {

constexpr double kSoftest = 1e-8;  // least CFM of a contact: keeps redundant points solvable
constexpr std::size_t kManyJoints = 256;
constexpr std::size_t kMaxInStep = 20000;      // points
constexpr std::size_t kMaxInMeshes = 500'000;  // tests, some tenths of a second
constexpr double kDeepest = 0.25;              // share of a box's thickness, at rest
constexpr double kUp = 0.9;                    // z of a unit normal: on a floor
constexpr double kPush =
    50.0;  // m/s^2, at which a soft contact lifts a body that is deep in the floor

constexpr double kWheelSettles = 2e-3;  // s, of the springs of wheels
constexpr double kSide = 0.5;           // |z| of the normal at a body's side, at most
// m/s, at which a yielding side parts from what presses on it: DART's threshold of bouncing.
constexpr double kRebound = 0.1;

// m/N, by which the side of a body yields to another that a joint to the world moves; 0 if it does
// not. A latched one is as rigid as the wall.
double side_yield(const Geom& geom, const Geom& other, const Vec3& normal) {
  const double stiffness = geom.body->side_stiffness;
  if (stiffness <= 0.0 || !other.body->dynamic() || std::abs(normal.z()) >= kSide) return 0.0;
  const std::vector<Joint*>& joints = other.body->mechanism->joints;
  const bool presses =
      other.body->mechanism->anchored() &&
      std::none_of(joints.begin(), joints.end(), [](const Joint* j) { return j->latched; });
  return presses ? 1.0 / stiffness : 0.0;
}

bool joined(const Body& a, const Body& b) {
  const Body& moving = a.dynamic() ? a : b;
  const Body& other = a.dynamic() ? b : a;
  return std::any_of(moving.joints.begin(), moving.joints.end(), [&](const Joint* joint) {
    return joint->first == &other || joint->second == &other;
  });
}

// N/m, of a contact that carries a mechanism with many wheels; 0 if rigid. Rigid ones may give any
// loads: a wheel that the error of a joint has lifted by a nanometer would carry nothing from then.
double stiffness_by_wheels(const Geom& a, const Geom& b) {
  const auto own = [](const Geom& geom) {
    return geom.body->mechanism == nullptr ? 0.0 : geom.body->mechanism->stiffness;
  };
  return std::max(own(a), own(b));
}

const MeshBoxes& boxes_of(const Geom& geom) {
  std::optional<MeshBoxes>& boxes = geom.mesh->boxes;
  if (!boxes) boxes.emplace(*geom.mesh->mesh);
  return *boxes;
}

}  // namespace

double parting_speed(const Geom& a, const Geom& b, const dContactGeom& at) {
  const Vec3 position = ode::vec(at.pos);
  const Vec3 velocity = a.body->velocity_at(position) - b.body->velocity_at(position);
  return velocity.dot(ode::vec(at.normal));
}

bool may_touch(const Geom& a, const Geom& b) {
  const Body& one = *a.body;
  const Body& two = *b.body;
  if (&one == &two || (!one.dynamic() && !two.dynamic())) return false;
  if (one.model != two.model) return true;
  return a.self_collides && b.self_collides && !joined(one, two);
}

Contacts::Contacts(const desc::Physics& settings, const Vec3& gravity)
    : step_(to_seconds(settings.step)) {
  set(settings, gravity);
}

void Contacts::set(const desc::Physics& settings, const Vec3& gravity) {
  gravity_ = gravity;
  erp_ = settings.erp;
  cfm_ = std::max(settings.cfm, kSoftest);
  surface_layer_ = settings.contact_surface_layer;
  fastest_ = settings.contact_max_correcting_vel;
}

void Contacts::use(dWorldID world) {
  world_ = world;
  group_ = ode::JointGroupHandle(dJointGroupCreate(0));
  most_joints_ = 0;
}

void Contacts::start() {
  for (const Pair& pair : pairs_) note_change(*pair.first, *pair.second);
  pairs_before_.swap(pairs_);
  points_before_.swap(points_);
  pairs_.clear();
  found_.clear();
  shares_.clear();
  points_.clear();
  in_meshes_ = 0;
  tangled_ = false;
}

bool Contacts::full() const { return found_.size() >= kMaxInStep || in_meshes_ >= kMaxInMeshes; }

// Whether two meshes would take more than is left of this step's tests.
bool Contacts::is_tangle(const Geom& a, const Geom& b) {
  if (!a.mesh || !b.mesh) return false;
  const std::size_t left = kMaxInMeshes - std::min(kMaxInMeshes, in_meshes_);
  const std::size_t tests = MeshBoxes::tests(boxes_of(a), a.body->at * a.in_body, boxes_of(b),
                                             b.body->at * b.in_body, left);
  in_meshes_ += tests;
  if (tests < left) return false;
  tangled_ = true;
  return true;
}

bool Contacts::collide(Geom& a, Geom& b) {
  Geom& first = a.serial < b.serial ? a : b;
  Geom& second = a.serial < b.serial ? b : a;
  std::array<dContactGeom, kMaxFound> found;
  const bool tangle = is_tangle(first, second);
  if (tangle && a.body->dynamic() && b.body->dynamic()) return false;
  const std::size_t n = tangle ? touching_box(first, second, found.data())
                               : touching_points(first, second, found.data());
  if (n == 0) return false;
  std::size_t kept = reduce_points(found.data(), n);
  if (first.body->upright && second.body->upright) kept = reduce_upright(found.data(), kept);
  std::array<PointShare, kMaxFound> shares;
  kept = add_middles(first, second, found.data(), kept, shares.data());
  note_change(first, second);
  pairs_.push_back({&first, &second, found_.size(), kept});
  const auto end = static_cast<std::ptrdiff_t>(kept);
  found_.insert(found_.end(), found.begin(), found.begin() + end);
  shares_.insert(shares_.end(), shares.begin(), shares.begin() + end);
  return true;
}

void Contacts::make_joints() {
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& a, const Pair& b) { return key_of(a) < key_of(b); });
  feedback_.assign(found_.size(), dJointFeedback{});
  sum_loads();
  start_grips();
  for (const Pair& pair : pairs_) {
    for (std::size_t i = 0; i < pair.count; ++i) make_joint(pair, pair.begin + i, true);
  }
}

void Contacts::make_joints_again(bool push) {
  dJointGroupEmpty(group_.get());
  for (const Pair& pair : pairs_) {
    if (!pair.first->body->again && !pair.second->body->again) continue;
    for (std::size_t i = 0; i < pair.count; ++i) make_joint(pair, pair.begin + i, push);
  }
}

void Contacts::make_joint(const Pair& pair, std::size_t index, bool pushes) {
  const Geom& a = *pair.first;
  const Geom& b = *pair.second;
  dContact contact{};
  contact.geom = found_[index];
  dSurfaceParameters& s = contact.surface;
  s.mode = dContactSoftERP | dContactSoftCFM;
  s.soft_erp = erp_;
  const PointShare& share = shares_[index];
  s.soft_cfm = std::max(cfm_ / share.stiffness, share.least_cfm);
  set_friction(contact, pair, index);
  double fastest = fastest_;
  const Vec3 normal = ode::vec(contact.geom.normal);
  const double side = std::max(side_yield(a, b, normal), side_yield(b, a, normal));
  const double parts_at = std::min({a.fastest, b.fastest, side > 0.0 ? kRebound : dInfinity});
  if (std::min(a.restitution, b.restitution) > 0.0) {
    s.mode |= dContactBounce;
    s.bounce = bounce(a, b, contact.geom);
    s.bounce_vel = kBounceSpeed;
  }
  const bool is_soft = a.stiffness || b.stiffness || side > 0.0;
  const double wheels = stiffness_by_wheels(a, b);
  if (!is_soft && wheels > 0.0 && contact.geom.depth < surface_layer_) {
    // The spring is pressed by all of the depth: ODE takes the layer off.
    contact.geom.depth = surface_layer_ + std::max(0.0, contact.geom.depth - share.depth);
    s.soft_erp = step_ / (step_ + kWheelSettles);
    s.soft_cfm = 1.0 / (share.spring * wheels * (step_ + kWheelSettles));
    return attach(contact, pair, index);
  }
  if (is_soft) {
    const double yield =
        (side * static_cast<double>(pair.count) + (a.stiffness ? 1.0 / *a.stiffness : 0.0) +
         (b.stiffness ? 1.0 / *b.stiffness : 0.0)) /
        share.stiffness;
    const double damping = share.stiffness * (a.damping.value_or(0.0) + b.damping.value_or(0.0));
    s.soft_erp = step_ / (step_ + damping * yield);
    s.soft_cfm = std::max(kSoftest, 1.0 / (step_ / yield + damping));
    // In a step it gains this share of the speed of parting: a soft spring pushes as deep as it is.
    const double gained = step_ / s.soft_cfm * (a.body->inverse_mass() + b.body->inverse_mass());
    fastest *= 1.0 + 1.0 / gained;
    if (std::isfinite(parts_at)) {
      const bool parts = parting_speed(a, b, contact.geom) >= parts_at;
      fastest = parts ? 0.0 : std::min(fastest, kPush * step_ * (1.0 + 1.0 / gained));
    }
  } else {
    fastest = std::min(fastest, parts_at);
  }
  if (a.min_depth || b.min_depth) {  // instead of the layer that ODE takes off all depths
    const double depth = std::min(std::max(a.min_depth.value_or(0.0), b.min_depth.value_or(0.0)),
                                  kDeepest * std::min(a.thickness, b.thickness));
    contact.geom.depth += surface_layer_ - depth;
  }
  if (!is_soft) {
    const double overlap = contact.geom.depth - surface_layer_;
    for (Body* body : {a.body, b.body}) body->overlap = std::max(body->overlap, overlap);
    if (!pushes) contact.geom.depth = std::min(contact.geom.depth, surface_layer_);
  }
  const double deepest = surface_layer_ + fastest * step_ / s.soft_erp;
  contact.geom.depth = std::min(contact.geom.depth, deepest);
  attach(contact, pair, index);
}

/// ODE wants a moving body first, and the normal towards it.
void Contacts::attach(dContact& contact, const Pair& pair, std::size_t index) {
  dBodyID one = pair.first->body->ode.get();
  dBodyID two = pair.second->body->ode.get();
  if (one == nullptr) {
    std::swap(one, two);
    for (int i = 0; i < 3; ++i) contact.geom.normal[i] = -contact.geom.normal[i];
  }
  dJointID joint = dJointCreateContact(world_, group_.get(), &contact);
  dJointAttach(joint, one, two);
  dJointSetFeedback(joint, &feedback_[index]);
}

void Contacts::read_forces(const Pair& pair) {
  const double sign = pair.first->body->ode != nullptr ? 1.0 : -1.0;
  for (std::size_t i = pair.begin; i < pair.begin + pair.count; ++i) {
    const dContactGeom& found = found_[i];
    Vec3 force = sign * ode::vec(feedback_[i].f1);
    if (!force.allFinite()) force = Vec3::Zero();  // the step found no motion
    points_[i] = {ode::vec(found.pos), ode::vec(found.normal), found.depth, force};
  }
}

bool Contacts::allow_long_steps() const {
  const auto hangs = [](const Body& body) { return body.dynamic() && !body.joints.empty(); };
  return std::all_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    if (hangs(*pair.first->body) || hangs(*pair.second->body)) return false;
    if (!pair.first->body->upright && !pair.second->body->upright) return true;
    if (pair.first->body->dynamic() && pair.second->body->dynamic()) return false;
    const auto first = points_.begin() + static_cast<std::ptrdiff_t>(pair.begin);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(pair.count),
                       [](const ContactPoint& at) { return std::abs(at.normal.z()) > kUp; });
  });
}

void Contacts::finish() {
  points_.resize(found_.size());
  for (const Pair& pair : pairs_) read_forces(pair);
  // Emptying a group visits all memory that it ever had.
  most_joints_ = std::max(most_joints_, found_.size());
  if (most_joints_ > kManyJoints && found_.size() < most_joints_ / 4) {
    group_ = ode::JointGroupHandle(dJointGroupCreate(0));
    most_joints_ = 0;
  } else {
    dJointGroupEmpty(group_.get());
  }
}

}  // namespace angen::physics
