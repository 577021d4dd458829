#include "physics/sleep.h"

#include <algorithm>
#include <cmath>

#include "core/lists.h"
#include "physics/drive.h"
#include "physics/islands.h"
#include "physics/shapes.h"

namespace angen::physics {

namespace {

constexpr double kSlow = 0.01;       // m/s
constexpr double kSlowTurn = 0.01;   // rad/s
constexpr double kStill = 1e-5;      // m
constexpr double kStillTurn = 1e-5;  // rad
constexpr double kIdleTime = 0.5;    // s
constexpr int kJitter = 10;          // idle steps that a fast one undoes, where steps are iterated

/// Whether it is where its idle time began: what is slow may be on its way, or turn back.
bool is_still(const Body& body) {
  return (body.at.position - body.idle_at.position).squaredNorm() < kStill * kStill &&
         body.at.rotation.angularDistance(body.idle_at.rotation) < kStillTurn;
}

int idle_steps(Body& body, int count) {
  const bool slow = body.velocity().squaredNorm() < kSlow * kSlow &&
                    body.spin().squaredNorm() < kSlowTurn * kSlowTurn && body.pushed < kSlow;
  if (!body.may_sleep) return 0;
  if (slow && body.idle_steps > 0 && (body.iterated || is_still(body))) {
    return body.idle_steps + count;
  }
  if (slow) {
    body.idle_at = body.at;
    return count;
  }
  // The iterated solution of a pile at rest is wrong for a step now and then.
  return body.iterated ? std::max(0, body.idle_steps - kJitter) : 0;
}

bool motor_turns(const Body& body) {
  return is_driven(body) ||
         std::any_of(body.joints.begin(), body.joints.end(), [](const Joint* joint) {
           return joint->motor_force > 0.0 && joint->motor_velocity != 0.0;
         });
}

void put_to_sleep(Body& body) {
  body.awake = false;
  if (body.ode != nullptr) take_out(*body.mechanism);
  for (Geom* geom : body.geoms) follow_body(*geom);
}

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
  erase_if(awake, [&](const Body* body) { return body->mechanism == &mechanism; });
}

bool let_sleep(std::vector<Body*>& awake, const Contacts& contacts, double h, int count) {
  const int long_enough = static_cast<int>(std::ceil(kIdleTime / h));
  bool any_idle = false;
  for (Body* body : awake) {
    body->idle_steps = idle_steps(*body, count);
    any_idle = any_idle || body->idle_steps >= long_enough;
  }
  if (!any_idle) return false;

  const Islands islands(awake, contacts.active());
  std::vector<char> restless(awake.size(), 0);
  for (const Body* body : awake) {
    if (body->idle_steps < long_enough || motor_turns(*body)) {
      restless[islands.of(*body)] = 1;
    }
  }
  const auto sleeps = [&](const Body* body) { return restless[islands.of(*body)] == 0; };
  const auto first = std::stable_partition(awake.begin(), awake.end(),
                                           [&](const Body* body) { return !sleeps(body); });
  if (first == awake.end()) return false;
  std::for_each(first, awake.end(), [](Body* body) { put_to_sleep(*body); });
  awake.erase(first, awake.end());
  return true;
}

}  // namespace angen::physics
