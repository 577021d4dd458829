#include "physics/sleep.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/insertion.h"
#include "physics/shapes.h"

namespace angen::physics {

namespace {

constexpr double kSlow = 0.01;      // m/s
constexpr double kSlowTurn = 0.01;  // rad/s
constexpr double kIdleTime = 0.5;   // s

bool motor_turns(const Body& body) {
  if (body.drive && body.drive->max_force > 0.0 &&
      (!body.drive->velocity.isZero() || body.drive->yaw_rate != 0.0)) {
    return true;
  }
  return std::any_of(body.joints.begin(), body.joints.end(), [](const Joint* joint) {
    return joint->motor_force > 0.0 && joint->motor_velocity != 0.0;
  });
}

// A body that has been stopped is like a static one.
bool joins(const Body& body) { return body.dynamic() && body.awake; }

void put_to_sleep(Body& body) {
  body.awake = false;
  if (body.ode != nullptr) take_out(*body.mechanism);
  for (Geom* geom : body.geoms) follow_body(*geom);
}

class Islands {
 public:
  explicit Islands(const std::vector<Body*>& bodies) : parent_(bodies.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) bodies[i]->island = i;
  }
  void join(const Body* a, const Body* b) {
    if (!joins(*a) || !joins(*b)) return;
    const std::uint32_t x = root(a->island);
    const std::uint32_t y = root(b->island);
    parent_[std::max(x, y)] = std::min(x, y);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

void wake_up(Body& body, std::vector<Body*>& awake) {
  if (body.awake || body.mechanism->stopped) return;
  for (Body* part : body.mechanism->bodies) {
    part->awake = true;
    awake.push_back(part);
  }
}

void stop(Mechanism& mechanism, std::vector<Body*>& awake) {
  mechanism.stopped = true;
  for (Body* body : mechanism.bodies) put_to_sleep(*body);
  awake.erase(std::remove_if(awake.begin(), awake.end(),
                             [&](const Body* body) { return body->mechanism == &mechanism; }),
              awake.end());
}

bool let_sleep(std::vector<Body*>& awake, const Contacts& contacts, double h) {
  const int long_enough = static_cast<int>(std::ceil(kIdleTime / h));
  bool any_idle = false;
  for (Body* body : awake) {
    const bool slow = body->velocity().squaredNorm() < kSlow * kSlow &&
                      body->spin().squaredNorm() < kSlowTurn * kSlowTurn;
    body->idle_steps = slow && body->may_sleep ? body->idle_steps + 1 : 0;
    any_idle = any_idle || body->idle_steps >= long_enough;
  }
  if (!any_idle) return false;

  Islands islands(awake);
  for (const Body* body : awake) {
    for (const Joint* joint : body->joints) islands.join(joint->first, joint->second);
  }
  for (const Contacts::Pair& pair : contacts.active()) {
    islands.join(pair.first->body, pair.second->body);
  }
  std::vector<char> restless(awake.size(), 0);
  for (const Body* body : awake) {
    if (body->idle_steps < long_enough || motor_turns(*body)) {
      restless[islands.root(body->island)] = 1;
    }
  }
  const auto sleeps = [&](const Body* body) { return restless[islands.root(body->island)] == 0; };
  const auto first = std::stable_partition(awake.begin(), awake.end(),
                                           [&](const Body* body) { return !sleeps(body); });
  if (first == awake.end()) return false;
  std::for_each(first, awake.end(), [](Body* body) { put_to_sleep(*body); });
  awake.erase(first, awake.end());
  return true;
}

}  // namespace angen::physics
