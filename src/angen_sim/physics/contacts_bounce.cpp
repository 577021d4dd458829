// Restitution at contacts.
#include <algorithm>
#include <cmath>

#include "physics/contacts.h"

namespace angen::physics {

namespace {

Vec3 free_fall(const Body& body, const Vec3& gravity) {
  return !body.dynamic() || body.floats || body.mechanism->anchored() ? Vec3(Vec3::Zero())
                                                                      : gravity;
}

}  // namespace

// The restitution is a share of the speed at the surface. A tick finds bodies deeper by the way
// since they touched; gravity has worked on that way, and will on the way back. Speeds are those
// between two ticks.
double Contacts::bounce(const Geom& a, const Geom& b, const dContactGeom& at) const {
  const double restitution = std::min(a.restitution, b.restitution);
  const Vec3 fall = free_fall(*a.body, gravity_) - free_fall(*b.body, gravity_);
  const double pull = -fall.dot(ode::vec(at.normal));  // m/s^2
  const double closing = -parting_speed(a, b, at);
  const double speed = closing + 0.5 * step_ * pull;
  const double work = 2.0 * pull * at.depth;
  const bool came_now = at.depth <= speed * step_ && work < speed * speed;
  if (pull == 0.0 || closing < kBounceSpeed || !came_now) return restitution;
  const double leaves = restitution * restitution * (speed * speed - work) + work;
  return std::max(0.0, std::sqrt(std::max(0.0, leaves)) - 0.5 * step_ * pull) / closing;
}

}  // namespace angen::physics
