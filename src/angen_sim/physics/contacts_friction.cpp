// Friction of contacts: its directions, and its bounds by Coulomb's law.
#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/contacts.h"

namespace angen::physics {

namespace {

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

bool iterated(const Contacts::Pair& pair) {
  return pair.first->body->iterated || pair.second->body->iterated;
}

}  // namespace

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
  if (grip.pressed < 0.0 || grip.firm || iterated(pair)) return;
  s.mode &= ~dContactApprox1;
  if (s.mu < dInfinity) s.mu *= grip.share.x() * grip.pressed;
  if (s.mu2 < dInfinity) s.mu2 *= grip.share.y() * grip.pressed;
}

// ODE bounds the friction along two directions, each by itself: a pyramid. Coulomb's cone follows
// from the choice of the first. A sliding contact has friction against its slip and none across.
// A contact that does not slide, or may stop within a step, has the first direction along the force
// that would make it slip: against the friction of the last step, and along the slip that is left.
// That force is one for all points between two mechanisms, as the share of each point is no load.
void Contacts::align(dContact& contact, const Pair& pair) const {
  const Body& a = *pair.first->body;
  const Body& b = *pair.second->body;
  const Vec3 normal = ode::vec(contact.geom.normal);
  const Vec3 position = ode::vec(contact.geom.pos);
  const Vec3 slip = across(normal, a.velocity_at(position) - b.velocity_at(position));
  const double inverse = a.inverse_mass() + b.inverse_mass();
  const auto found = loads_.find(mechanisms_of(pair));
  Vec3 load = slip / (step_ * inverse);  // N, on the first body
  if (found == loads_.end()) {
    const double falls = (a.dynamic() ? 1.0 : 0.0) - (b.dynamic() ? 1.0 : 0.0);
    load += falls / inverse * across(normal, gravity_);
  } else {
    const Load& last = found->second;
    const double stopped = kStopSteps * contact.surface.mu * last.pressed * step_ * inverse;
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
    if (iterated(pair) || pair.first->body->parts || pair.second->body->parts) continue;
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
