#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "physics/model.h"

namespace angen::physics {

/// The motion of a body, and the forces on it in the next step.
struct BodyState {
  Vec3 position;
  Quat rotation;
  Vec3 velocity;
  Vec3 spin;
  Vec3 force;
  Vec3 torque;
};
BodyState state_of(const Body& body);
void restore(const Body& body, const BodyState& state);

/// A body that a step would take beyond the limits (core/limits.h), and how.
struct Unstable {
  Body* body = nullptr;
  std::string why;
};

/// The errors of a step.
struct Trouble {
  std::vector<Unstable> unstable;
  bool never = false;   // no solver found a motion: all bodies are as before the step
  bool broken = false;  // ODE failed within the step: its world cannot be stepped again
};

/// Integrates one step of h seconds: bodies of large islands (physics/islands.h) by
/// dWorldQuickStep, the other awake ones by dWorldStep.
void step_by_size(dWorldID world, const std::vector<Body*>& awake, double h, std::uint64_t seed,
                  std::int64_t tick);

/// Integrates one step of h seconds. When `first_try` (dWorldStep unless a test says otherwise)
/// fails, the awake bodies are put back to where they started and the step is taken by
/// dWorldQuickStep, whose shuffling is seeded with (seed, tick). Bodies must be all that are
/// enabled in the world. Returns false when the step had to be taken again.
bool solve_step(dWorldID world, const std::vector<Body*>& awake, double h, std::uint64_t seed,
                std::int64_t tick,
                const std::function<void(dWorldID, double)>& first_try = dWorldStep,
                Trouble* trouble = nullptr);

}  // namespace angen::physics
