#include "physics/contact_law.h"

#include <algorithm>
#include <cmath>

namespace angen::physics {

namespace {

constexpr double kBounceSpeed = 0.05;  // m/s, nothing bounces below it
constexpr double kSoftest = 1e-8;      // least CFM of a contact: keeps redundant points solvable
constexpr double kDeepest = 0.25;      // share of a box's thickness, at rest
constexpr double kPush =
    50.0;  // m/s^2, at which a soft contact lifts a body that is deep in the floor
constexpr double kWheelSettles = 2e-3;  // s, of the springs of wheels
constexpr double kSide = 0.5;           // |z| of the normal at a body's side, at most
// m/s, at which a yielding side parts from what presses on it: DART's threshold of bouncing.
constexpr double kRebound = 0.1;

// A side yields to another that a joint to the world moves. A latched one is as rigid as the wall.
double yield_of_side(const Geom& geom, const Geom& other, const Vec3& normal) {
  const double stiffness = geom.body->side_stiffness;
  if (stiffness <= 0.0 || !other.body->dynamic() || std::abs(normal.z()) >= kSide) return 0.0;
  const std::vector<Joint*>& joints = other.body->mechanism->joints;
  const bool presses =
      other.body->mechanism->anchored() &&
      std::none_of(joints.begin(), joints.end(), [](const Joint* j) { return j->latched; });
  return presses ? 1.0 / stiffness : 0.0;
}

// Rigid contacts may give any loads: a wheel that the error of a joint has lifted by a nanometer
// would carry nothing from then.
double stiffness_by_wheels(const Geom& geom) {
  return geom.body->mechanism == nullptr ? 0.0 : geom.body->mechanism->stiffness;
}

Vec3 free_fall(const Body& body, const Vec3& gravity) {
  return !body.dynamic() || body.floats || body.mechanism->anchored() ? Vec3(Vec3::Zero())
                                                                      : gravity;
}

double yield_of(const Geom& geom) { return geom.stiffness ? 1.0 / *geom.stiffness : 0.0; }

}  // namespace

ContactLaw::ContactLaw(const Geom& a, const Geom& b, std::size_t points,
                       const ContactSettings& settings)
    : a_(a),
      b_(b),
      settings_(settings),
      points_(static_cast<double>(points)),
      restitution_(std::min(a.restitution, b.restitution)),
      wheels_(std::max(stiffness_by_wheels(a), stiffness_by_wheels(b))) {}

double ContactLaw::side_yield(const Vec3& normal) const {
  return std::max(yield_of_side(a_, b_, normal), yield_of_side(b_, a_, normal));
}

double ContactLaw::parting_speed(const dContactGeom& at) const {
  const Vec3 position = ode::vec(at.pos);
  const Vec3 velocity = a_.body->velocity_at(position) - b_.body->velocity_at(position);
  return velocity.dot(ode::vec(at.normal));
}

void ContactLaw::apply(const PointShare& share, bool pushes, dContact& contact) const {
  dContactGeom& at = contact.geom;
  dSurfaceParameters& s = contact.surface;
  s.mode |= dContactSoftERP | dContactSoftCFM;
  s.soft_erp = settings_.erp;
  s.soft_cfm = std::max(std::max(settings_.cfm, kSoftest) / share.stiffness, share.least_cfm);
  if (restitution_ > 0.0) {
    s.mode |= dContactBounce;
    s.bounce = bounce(at);
    s.bounce_vel = kBounceSpeed;
  }
  const double layer = settings_.surface_layer;
  const double side = side_yield(ode::vec(at.normal));
  const bool is_soft = a_.stiffness || b_.stiffness || side > 0.0;
  if (!is_soft && wheels_ > 0.0 && at.depth < layer) return press_wheels(share, contact);
  const double parts_at = std::min({a_.fastest, b_.fastest, side > 0.0 ? kRebound : dInfinity});
  const double fastest =
      is_soft ? soften(share, side, parts_at, contact) : std::min(settings_.fastest, parts_at);
  set_min_depth(at);
  if (!is_soft) {
    const double overlap = at.depth - layer;
    for (Body* body : {a_.body, b_.body}) body->overlap = std::max(body->overlap, overlap);
    if (!pushes) at.depth = std::min(at.depth, layer);
  }
  at.depth = std::min(at.depth, layer + fastest * settings_.step / s.soft_erp);
}

// The spring is pressed by all of the depth: ODE takes the layer off.
void ContactLaw::press_wheels(const PointShare& share, dContact& contact) const {
  const double step = settings_.step;
  contact.geom.depth = settings_.surface_layer + std::max(0.0, contact.geom.depth - share.depth);
  contact.surface.soft_erp = step / (step + kWheelSettles);
  contact.surface.soft_cfm = 1.0 / (share.spring * wheels_ * (step + kWheelSettles));
}

double ContactLaw::soften(const PointShare& share, double side, double parts_at,
                          dContact& contact) const {
  dSurfaceParameters& s = contact.surface;
  const double step = settings_.step;
  const double yield = (side * points_ + yield_of(a_) + yield_of(b_)) / share.stiffness;
  const double damping = share.stiffness * (a_.damping.value_or(0.0) + b_.damping.value_or(0.0));
  s.soft_erp = step / (step + damping * yield);
  s.soft_cfm = std::max(kSoftest, 1.0 / (step / yield + damping));
  // In a step it gains this share of the speed of parting: a soft spring pushes as deep as it is.
  const double gained = step / s.soft_cfm * (a_.body->inverse_mass() + b_.body->inverse_mass());
  const double fastest = settings_.fastest * (1.0 + 1.0 / gained);
  if (!std::isfinite(parts_at)) return fastest;
  const bool parts = parting_speed(contact.geom) >= parts_at;
  return parts ? 0.0 : std::min(fastest, kPush * step * (1.0 + 1.0 / gained));
}

// ODE takes a layer off all depths; this makes that layer the least depth of the surfaces.
void ContactLaw::set_min_depth(dContactGeom& at) const {
  if (!a_.min_depth && !b_.min_depth) return;
  const double depth = std::min(std::max(a_.min_depth.value_or(0.0), b_.min_depth.value_or(0.0)),
                                kDeepest * std::min(a_.thickness, b_.thickness));
  at.depth += settings_.surface_layer - depth;
}

// The restitution is a share of the speed at the surface. A tick finds bodies deeper by the way
// since they touched; gravity has worked on that way, and will on the way back. Speeds are those
// between two ticks.
double ContactLaw::bounce(const dContactGeom& at) const {
  const double step = settings_.step;
  const Vec3 fall = free_fall(*a_.body, settings_.gravity) - free_fall(*b_.body, settings_.gravity);
  const double pull = -fall.dot(ode::vec(at.normal));  // m/s^2
  const double closing = -parting_speed(at);
  const double speed = closing + 0.5 * step * pull;
  const double work = 2.0 * pull * at.depth;
  const bool came_now = at.depth <= speed * step && work < speed * speed;
  if (pull == 0.0 || closing < kBounceSpeed || !came_now) return restitution_;
  const double leaves = restitution_ * restitution_ * (speed * speed - work) + work;
  return std::max(0.0, std::sqrt(std::max(0.0, leaves)) - 0.5 * step * pull) / closing;
}

}  // namespace angen::physics
