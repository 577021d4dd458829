#include "physics/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/lists.h"
#include "core/time.h"
#include "physics/drive.h"
#include "physics/touching.h"

namespace angen::physics {

namespace {

constexpr std::size_t kManyJoints = 256;
constexpr std::size_t kMaxInStep = 20000;      // points
constexpr std::size_t kMaxInMeshes = 500'000;  // tests, some tenths of a second
constexpr double kUp = 0.9;                    // z of a unit normal: on a floor

bool joined(const Body& a, const Body& b) {
  const Body& moving = a.dynamic() ? a : b;
  const Body& other = a.dynamic() ? b : a;
  return std::any_of(moving.joints.begin(), moving.joints.end(), [&](const Joint* joint) {
    return joint->first == &other || joint->second == &other;
  });
}

const MeshBoxes& boxes_of(const Geom& geom) {
  std::optional<MeshBoxes>& boxes = geom.mesh->boxes;
  if (!boxes) boxes.emplace(*geom.mesh->mesh);
  return *boxes;
}

/// Turned so that `geom`, one of the two, is the first.
ContactPair seen_from(const Geom& geom, const Geom& first, const Geom& second,
                      std::vector<ContactPoint> points) {
  if (&first == &geom) return {first.name, second.name, std::move(points)};
  for (ContactPoint& point : points) {
    point.normal = -point.normal;
    point.force = -point.force;
  }
  return {second.name, first.name, std::move(points)};
}

constexpr double kStickMu = 1e6;  // from here on nothing slides
constexpr double kStopSteps =
    2.0;  // contacts that friction stops within this many steps do not slide
constexpr double kMinSlip = 1e-6;     // m/s
constexpr double kMinLoad = 1e-6;     // N
constexpr double kAgree = 0.015;      // share of a normal force by which a bound may be wrong
constexpr double kAgreeForce = 1e-5;  // N
constexpr double kFirm = 0.3;         // share of its bound, below which friction is far from it
constexpr double kAtBound = 0.999;
// Bounds of the share of its error by which a pass corrects a bound.
constexpr double kLeastShare = 0.2;
constexpr double kMostShare = 1.0;

double usable_mu(double mu) { return mu >= kStickMu ? dInfinity : std::max(0.0, mu); }

// The dynamic one first, and none for a static one.
std::pair<const Mechanism*, const Mechanism*> mechanisms_of(const Contacts::Pair& pair) {
  const Body& a = *pair.first->body;
  const Body& b = *pair.second->body;
  return a.dynamic() ? std::pair(a.mechanism, b.mechanism) : std::pair(b.mechanism, a.mechanism);
}

Vec3 across(const Vec3& normal, const Vec3& v) { return v - normal.dot(v) * normal; }

void set_direction(dContact& contact, const Vec3& direction) {
  contact.surface.mode |= dContactFDir1;
  for (int i = 0; i < 3; ++i) contact.fdir1[i] = direction[i];
}

void keep_direction(dContact& contact, const Geom& a, const Geom& b) {
  const Geom& chooser = a.friction.direction1.isZero() ? b : a;
  const Vec3 given =
      chooser.body->at.rotation * (chooser.in_body.rotation * chooser.friction.direction1);
  const Vec3 along = across(ode::vec(contact.geom.normal), given);
  if (along.norm() > 1e-6) set_direction(contact, along.normalized());
}

/// Whether ODE's own bounds apply.
bool without_passes(const Contacts::Pair& pair) {
  const auto is = [](const Body& body) { return body.iterated || body.passes < 0; };
  return is(*pair.first->body) || is(*pair.second->body);
}

}  // namespace

bool may_touch(const Geom& a, const Geom& b) {
  const Body& one = *a.body;
  const Body& two = *b.body;
  if (&one == &two || (!one.dynamic() && !two.dynamic())) return false;
  if (one.model != two.model) return true;
  return a.self_collides && b.self_collides && !joined(one, two);
}

Contacts::Contacts(const desc::Physics& settings, const Vec3& gravity) {
  settings_.step = to_seconds(settings.step);
  set(settings, gravity);
}

void Contacts::set(const desc::Physics& settings, const Vec3& gravity) {
  settings_.gravity = gravity;
  settings_.erp = settings.erp;
  settings_.cfm = settings.cfm;
  settings_.surface_layer = settings.contact_surface_layer;
  settings_.fastest = settings.contact_max_correcting_vel;
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
  for (const Pair& pair : pairs_) make_joints_of(pair, true);
}

void Contacts::make_joints_again(bool push) {
  dJointGroupEmpty(group_.get());
  for (const Pair& pair : pairs_) {
    if (pair.first->body->again || pair.second->body->again) make_joints_of(pair, push);
  }
}

void Contacts::make_joints_of(const Pair& pair, bool push) {
  const ContactLaw law(*pair.first, *pair.second, pair.count, settings_);
  for (std::size_t i = pair.begin; i < pair.begin + pair.count; ++i) {
    dContact contact{};
    contact.geom = found_[i];
    set_friction(contact, pair, i);
    law.apply(shares_[i], push, contact);
    attach(contact, pair, i);
  }
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

bool Contacts::allow_long_steps(int idle_steps) const {
  const auto hangs = [](const Body& body) { return body.dynamic() && !body.joints.empty(); };
  const auto is_calm = [&](const Body& body) {
    return !body.dynamic() || (body.idle_steps >= idle_steps && !is_driven(body));
  };
  return std::all_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    const Body& one = *pair.first->body;
    const Body& other = *pair.second->body;
    if (hangs(one) || hangs(other)) return false;
    if (!one.upright && !other.upright) return true;
    if (is_calm(one) && is_calm(other)) return true;
    if (one.dynamic() && other.dynamic()) return false;
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

void Contacts::remember(std::int64_t tick) {
  for (const Pair& pair : pairs_) {
    for (auto [one, other] :
         {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
      if (!one->watched) continue;
      one->recent[other->serial] = {tick,
                                    seen_from(*one, *pair.first, *pair.second, points_of(pair))};
    }
  }
}

std::vector<ContactPair> Contacts::with_recent(Geom& geom, std::int64_t first,
                                               std::vector<ContactPair> now) {
  geom.watched = true;
  const std::size_t current = now.size();
  for (auto at = geom.recent.begin(); at != geom.recent.end();) {
    if (at->second.tick < first) {
      at = geom.recent.erase(at);
      continue;
    }
    const ContactPair& pair = (at++)->second.pair;
    const auto end = now.begin() + static_cast<std::ptrdiff_t>(current);
    const bool touches = std::any_of(
        now.begin(), end, [&](const ContactPair& each) { return each.second == pair.second; });
    if (!touches) now.push_back(pair);
  }
  return now;
}

void Contacts::put_to_rest() {
  const auto asleep = [](const Pair& pair) {
    return !pair.first->body->awake && !pair.second->body->awake;
  };
  for (const Pair& pair : pairs_) {
    if (!asleep(pair)) continue;
    const PairKey key = key_of(pair);
    resting_[key] = {pair.first, pair.second, points_of(pair)};
    with_smaller_.emplace(key.second, key.first);
    for (Body* body : {pair.first->body, pair.second->body}) {
      if (body->dynamic()) body->resting.push_back(key);
    }
  }
  erase_if(pairs_, asleep);
}

void Contacts::forget(Body& body) {
  for (const PairKey& key : body.resting) {
    const auto pair = resting_.find(key);
    if (pair == resting_.end()) continue;
    note_change(*pair->second.first, *pair->second.second);
    resting_.erase(pair);
    with_smaller_.erase({key.second, key.first});
  }
  body.resting.clear();
}

void Contacts::drop_active(const ModelRecord& model) {
  const auto gone = [&](const Pair& pair) {
    if (pair.first->body->model != &model && pair.second->body->model != &model) return false;
    note_change(*pair.first, *pair.second);
    return true;
  };
  erase_if(pairs_, gone);
}

std::vector<ContactPoint> Contacts::points_of(const Pair& pair) const {
  const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(pair.begin);
  return {begin, begin + static_cast<std::ptrdiff_t>(pair.count)};
}

std::vector<ContactPair> Contacts::of(const Geom& geom) const {
  std::map<std::uint64_t, ContactPair> found;  // by the other's serial
  const auto add = [&](const Geom& first, const Geom& second, std::vector<ContactPoint> points) {
    found[&first == &geom ? second.serial : first.serial] =
        seen_from(geom, first, second, std::move(points));
  };
  for (const Pair& pair : pairs_) {
    if (pair.first == &geom || pair.second == &geom)
      add(*pair.first, *pair.second, points_of(pair));
  }
  const auto add_resting = [&](const Resting& r) { add(*r.first, *r.second, r.points); };
  const PairKey start{geom.serial, 0};
  for (auto at = resting_.lower_bound(start);
       at != resting_.end() && at->first.first == geom.serial; ++at) {
    add_resting(at->second);
  }
  for (auto at = with_smaller_.lower_bound(start);
       at != with_smaller_.end() && at->first == geom.serial; ++at) {
    add_resting(resting_.at({at->second, at->first}));
  }
  std::vector<ContactPair> all;
  all.reserve(found.size());
  for (auto& [serial, pair] : found) all.push_back(std::move(pair));
  return all;
}

std::vector<ContactPair> Contacts::list() const {
  std::vector<ContactPair> all;
  all.reserve(pairs_.size() + resting_.size());
  auto sleeping = resting_.begin();
  const auto take_sleeping = [&] {
    const Resting& r = (sleeping++)->second;
    all.push_back({r.first->name, r.second->name, r.points});
  };
  for (const Pair& pair : pairs_) {
    const PairKey key = key_of(pair);
    while (sleeping != resting_.end() && sleeping->first < key) take_sleeping();
    all.push_back({pair.first->name, pair.second->name, points_of(pair)});
  }
  while (sleeping != resting_.end()) take_sleeping();
  return all;
}

void Contacts::set_friction(dContact& contact, const Pair& pair, std::size_t index) {
  const Geom& a = *pair.first;
  const Geom& b = *pair.second;
  const PointShare& share = shares_[index];
  dSurfaceParameters& s = contact.surface;
  s.mode |= dContactApprox1 | dContactMu2;
  s.mu = share.friction * usable_mu(std::min(a.friction.mu, b.friction.mu));
  s.mu2 = share.friction * usable_mu(std::min(a.friction.mu2, b.friction.mu2));
  s.slip1 = (a.friction.slip1 + b.friction.slip1) / share.stiffness;
  s.slip2 = (a.friction.slip2 + b.friction.slip2) / share.stiffness;
  if (s.slip1 > 0.0) s.mode |= dContactSlip1;
  if (s.slip2 > 0.0) s.mode |= dContactSlip2;
  Grip& grip = grips_[index];
  grip.mu = {s.mu, s.mu2};
  grip.cone = s.mu == s.mu2 && s.slip1 == s.slip2;
  if (!grip.cone) {
    keep_direction(contact, a, b);
  } else if (s.mu > 0.0 && s.mu < dInfinity) {
    align(contact, pair);
  }
  if ((s.mode & dContactFDir1) == 0) {
    dVector3 first, second;
    dPlaneSpace(contact.geom.normal, first, second);
    set_direction(contact, ode::vec(first));
  }
  grip.along = ode::vec(contact.fdir1);
  if (grip.pressed < 0.0 || grip.firm || without_passes(pair)) return;
  s.mode &= ~dContactApprox1;
  if (s.mu < dInfinity) s.mu *= grip.share.x() * grip.pressed;
  if (s.mu2 < dInfinity) s.mu2 *= grip.share.y() * grip.pressed;
}

// ODE bounds the friction along two directions, each by itself: a pyramid. Coulomb's cone follows
// from the choice of the first. A sliding contact has friction against its slip and none across.
// A contact that does not slide, or may stop within a step, has the first direction along the
// force that would make it slip: against the friction of the last step, and along the slip that is
// left. That force is one for all points between two mechanisms, as the share of each point is no
// load.
void Contacts::align(dContact& contact, const Pair& pair) const {
  const Body& a = *pair.first->body;
  const Body& b = *pair.second->body;
  const Vec3 normal = ode::vec(contact.geom.normal);
  const Vec3 position = ode::vec(contact.geom.pos);
  const Vec3 slip = across(normal, a.velocity_at(position) - b.velocity_at(position));
  const double inverse = a.inverse_mass() + b.inverse_mass();
  const auto found = loads_.find(mechanisms_of(pair));
  Vec3 load = slip / (settings_.step * inverse);  // N, on the first body
  if (found == loads_.end()) {
    const double falls = (a.dynamic() ? 1.0 : 0.0) - (b.dynamic() ? 1.0 : 0.0);
    load += falls / inverse * across(normal, settings_.gravity);
  } else {
    const Load& last = found->second;
    const double stopped =
        kStopSteps * contact.surface.mu * last.pressed * settings_.step * inverse;
    if (slip.norm() > std::max(stopped, kMinSlip)) {  // m/s
      contact.surface.mu2 = 0.0;
      return set_direction(contact, slip.normalized());
    }
    load -= (a.dynamic() ? 1.0 : -1.0) * across(normal, last.friction);
  }
  if (load.norm() > kMinLoad) set_direction(contact, load.normalized());
}

void Contacts::sum_loads() {
  loads_.clear();
  for (const Pair& pair : pairs_before_) {
    const double sign = pair.first->body->dynamic() ? 1.0 : -1.0;
    Load& load = loads_[mechanisms_of(pair)];
    for (std::size_t i = pair.begin; i < pair.begin + pair.count; ++i) {
      const ContactPoint& point = points_before_[i];
      const double pressed = point.normal.dot(point.force);
      load.pressed += std::abs(pressed);
      load.friction += sign * (point.force - pressed * point.normal);
    }
  }
}

// The nearest of some points of the step before.
const ContactPoint& Contacts::nearest_before(const Pair& pair, const Vec3& at) const {
  double nearest = dInfinity;
  const ContactPoint* found = nullptr;
  for (std::size_t i = pair.begin; i < pair.begin + pair.count; ++i) {
    const ContactPoint& point = points_before_[i];
    const double distance = (point.position - at).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    found = &point;
  }
  return *found;
}

void Contacts::start_grips() {
  grips_.assign(found_.size(), Grip{});
  auto before = pairs_before_.begin();
  for (const Pair& pair : pairs_) {
    while (before != pairs_before_.end() && key_of(*before) < key_of(pair)) ++before;
    if (before == pairs_before_.end()) break;
    if (key_of(*before) != key_of(pair)) continue;
    for (std::size_t i = pair.begin; i < pair.begin + pair.count; ++i) {
      const ContactPoint& last = nearest_before(*before, ode::vec(found_[i].pos));
      grips_[i].pressed = std::abs(last.normal.dot(last.force));
      const double mu = std::min(pair.first->friction.mu, pair.second->friction.mu);
      grips_[i].firm = across(last.normal, last.force).norm() < kFirm * mu * grips_[i].pressed;
    }
  }
  pairs_before_.clear();
}

bool Contacts::revise_friction(bool lower) {
  bool any = false;
  for (const Pair& pair : pairs_) {
    if (without_passes(pair) || pair.first->body->parts || pair.second->body->parts) continue;
    bool wrong = false;
    for (std::size_t i = 0; i < pair.count; ++i) wrong = revise(pair.begin + i, lower) || wrong;
    if (!wrong) continue;
    any = true;
    for (Body* body : {pair.first->body, pair.second->body}) body->again = body->dynamic();
  }
  return any;
}

bool Contacts::revise(std::size_t index, bool lower) {
  Grip& grip = grips_[index];
  const Vec3 normal = ode::vec(found_[index].normal);
  const Vec3 force = ode::vec(feedback_[index].f1);
  const double pressed = std::abs(normal.dot(force));
  const Vec3 friction = across(normal, force);
  const Eigen::Vector2d parts(grip.along.dot(friction), normal.cross(grip.along).dot(friction));
  const double needed = grip.needed(parts);
  if (!force.allFinite() || needed == 0.0) return false;
  const double margin = kAgree * pressed + kAgreeForce;
  const bool beyond = needed > pressed + margin;
  const bool below = !grip.firm && grip.pressed >= 0.0 && needed >= kAtBound * grip.pressed &&
                     pressed > grip.pressed + margin;
  if (grip.cone && needed > pressed) grip.share = parts.cwiseAbs().normalized();
  grip.firm = grip.firm && needed < kFirm * pressed;
  grip.correct(pressed, lower);
  return beyond || (below && !lower);
}

double Contacts::Grip::needed(const Eigen::Vector2d& friction) const {
  double most = 0.0;
  for (int i = 0; i < 2; ++i) {
    if (mu[i] > 0.0)
      most = std::max(most, (cone ? friction.norm() : std::abs(friction[i])) / mu[i]);
  }
  return most;
}

// By the share of the error that the last two passes suggest, as if a step's normal force were a
// linear function of `pressed`.
void Contacts::Grip::correct(double gave, bool lower) {
  const double now = gave - pressed;
  if (pressed < 0.0 || (lower && now < 0.0)) {
    pressed = gave;
  } else if (!lower) {
    if (error != 0.0 && now != error) {
      const double exact = corrected * error / (error - now);
      corrected = exact > 0.0 ? std::clamp(exact, kLeastShare, kMostShare) : kMostShare;
    }
    error = now;
    pressed += corrected * now;
  }
}

}  // namespace angen::physics
