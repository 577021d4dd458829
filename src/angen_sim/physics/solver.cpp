#include "physics/solver.h"

#include <algorithm>

#include "core/random.h"

namespace angen::physics {

namespace {

struct State {
  Vec3 position;
  Quat rotation;
  Vec3 velocity;
  Vec3 spin;
  Vec3 force;
  Vec3 torque;
};

State state_of(const Body& body) {
  dBodyID b = body.ode.get();
  return {ode::vec(dBodyGetPosition(b)),  ode::quat(dBodyGetQuaternion(b)),
          ode::vec(dBodyGetLinearVel(b)), ode::vec(dBodyGetAngularVel(b)),
          ode::vec(dBodyGetForce(b)),     ode::vec(dBodyGetTorque(b))};
}

void restore(const Body& body, const State& s) {
  dBodyID b = body.ode.get();
  ode::set_pose(b, {s.position, s.rotation});
  dBodySetLinearVel(b, s.velocity.x(), s.velocity.y(), s.velocity.z());
  dBodySetAngularVel(b, s.spin.x(), s.spin.y(), s.spin.z());
  dBodySetForce(b, s.force.x(), s.force.y(), s.force.z());
  dBodySetTorque(b, s.torque.x(), s.torque.y(), s.torque.z());
}

bool finite(const Body& body) {
  const State s = state_of(body);
  return s.position.allFinite() && s.rotation.coeffs().allFinite() && s.velocity.allFinite() &&
         s.spin.allFinite();
}

bool all_finite(const std::vector<Body*>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(), [](const Body* b) { return finite(*b); });
}

}  // namespace

bool solve_step(dWorldID world, const std::vector<Body*>& awake, double h, std::uint64_t seed,
                std::int64_t tick, const std::function<void(dWorldID, double)>& first_try) {
  thread_local std::vector<State> start;
  start.clear();
  for (const Body* body : awake) start.push_back(state_of(*body));
  ode::take_lcp_failure();
  first_try(world, h);
  if (!ode::take_lcp_failure() && all_finite(awake)) return true;

  for (std::size_t i = 0; i < awake.size(); ++i) restore(*awake[i], start[i]);
  dRandSetSeed(static_cast<unsigned long>(Rng(seed, hash_bytes("physics"), tick).next()));
  dWorldQuickStep(world, h);
  // Should even that end nowhere, the bodies stand still for this step.
  if (!all_finite(awake)) {
    for (std::size_t i = 0; i < awake.size(); ++i) {
      State still = start[i];
      still.velocity = still.spin = still.force = still.torque = Vec3::Zero();
      restore(*awake[i], still);
    }
  }
  return false;
}

}  // namespace angen::physics
