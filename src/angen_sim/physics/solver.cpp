#include "physics/solver.h"

#include <algorithm>

#include "core/limits.h"
#include "core/random.h"
#include "core/text.h"

namespace angen::physics {

BodyState state_of(const Body& body) {
  dBodyID b = body.ode.get();
  return {ode::vec(dBodyGetPosition(b)),  ode::quat(dBodyGetQuaternion(b)),
          ode::vec(dBodyGetLinearVel(b)), ode::vec(dBodyGetAngularVel(b)),
          ode::vec(dBodyGetForce(b)),     ode::vec(dBodyGetTorque(b))};
}

void restore(const Body& body, const BodyState& s) {
  dBodyID b = body.ode.get();
  ode::set_pose(b, {s.position, s.rotation});
  dBodySetLinearVel(b, s.velocity.x(), s.velocity.y(), s.velocity.z());
  dBodySetAngularVel(b, s.spin.x(), s.spin.y(), s.spin.z());
  dBodySetForce(b, s.force.x(), s.force.y(), s.force.z());
  dBodySetTorque(b, s.torque.x(), s.torque.y(), s.torque.z());
}

namespace {

std::string too_fast(double speed, const Limit& limit) {
  return "its speed would be " + number_text(speed) + " " + limit.unit + ", more than " +
         number_text(limit.most);
}

// "" where the body is within the limits.
std::string instability(const Body& body) {
  const BodyState s = state_of(body);
  if (!s.velocity.allFinite() || !s.spin.allFinite() || !s.rotation.coeffs().allFinite()) {
    return "its motion has no finite solution";
  }
  if (s.velocity.norm() > limits::kSpeed.most) return too_fast(s.velocity.norm(), limits::kSpeed);
  if (s.spin.norm() > limits::kTurnRate.most) return too_fast(s.spin.norm(), limits::kTurnRate);
  const std::string problem = pose_problem({s.position, s.rotation});
  return problem.empty() ? "" : "its position: " + problem;
}

void list_unstable(const std::vector<Body*>& bodies, std::vector<Unstable>& unstable) {
  unstable.clear();
  for (Body* body : bodies) {
    std::string why = instability(*body);
    if (!why.empty()) unstable.push_back({body, std::move(why)});
  }
}

bool all_finite(const std::vector<Body*>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(), [](const Body* body) {
    const BodyState s = state_of(*body);
    return s.position.allFinite() && s.rotation.coeffs().allFinite() && s.velocity.allFinite() &&
           s.spin.allFinite();
  });
}

void iterate(dWorldID world, double h, std::uint64_t seed, std::int64_t tick) {
  dRandSetSeed(static_cast<unsigned long>(Rng(seed, hash_bytes("physics"), tick).next()));
  dWorldQuickStep(world, h);
}

}  // namespace

void step_by_size(dWorldID world, const std::vector<Body*>& awake, double h, std::uint64_t seed,
                  std::int64_t tick) {
  const auto enable = [&](bool iterated) {
    for (const Body* body : awake) {
      body->iterated == iterated ? dBodyEnable(body->ode.get()) : dBodyDisable(body->ode.get());
    }
  };
  enable(false);
  dWorldStep(world, h);
  enable(true);
  iterate(world, h, seed, tick);
  for (const Body* body : awake) dBodyEnable(body->ode.get());
}

bool solve_step(dWorldID world, const std::vector<Body*>& awake, double h, std::uint64_t seed,
                std::int64_t tick, const std::function<void(dWorldID, double)>& first_try,
                Trouble* trouble) {
  thread_local std::vector<BodyState> start;
  start.clear();
  for (const Body* body : awake) start.push_back(state_of(*body));
  const auto back = [&](bool forces) {
    for (std::size_t i = 0; i < awake.size(); ++i) {
      BodyState state = start[i];
      if (!forces) state.force = state.torque = Vec3::Zero();
      restore(*awake[i], state);
    }
  };
  Trouble unused;
  Trouble& found = trouble == nullptr ? unused : *trouble;
  found = {};
  bool first = true;
  try {
    ode::take_lcp_failure();
    first_try(world, h);
    if (ode::take_lcp_failure() || !all_finite(awake)) {
      first = false;
      back(true);
      iterate(world, h, seed, tick);
      found.never = !all_finite(awake);
    }
  } catch (const ode::Failure&) {
    first = false;
    found.never = found.broken = true;
  }
  list_unstable(awake, found.unstable);
  if (found.never) back(false);
  return first;
}

}  // namespace angen::physics
