#include <algorithm>
#include <set>

#include "core/lists.h"
#include "physics/drive.h"
#include "physics/gyroscopic.h"
#include "physics/impl.h"
#include "physics/islands.h"
#include "physics/joints.h"
#include "physics/parting.h"
#include "physics/shapes.h"
#include "physics/sleep.h"
#include "physics/solver.h"

namespace angen::physics {

namespace {

// Most passes that look for the bounds of friction; in the second half they only fall.
constexpr int kPasses = 24;
constexpr int kGainedPasses = 2;     // in a step
constexpr int kStepsWithout = 3000;  // after an island has spent its passes

void gain_passes(Body& body) {
  if (body.passes < 0) {
    if (++body.passes == 0) body.passes = kSavedPasses;
  } else {
    body.passes = std::min(body.passes + kGainedPasses, kSavedPasses);
  }
}

/// Marks the whole islands of the bodies that are marked `again`, if they have joints or a pass
/// left. Returns whether any has.
bool spend_pass(const std::vector<Body*>& awake, const Islands& islands) {
  std::vector<char> again(awake.size(), 0), jointed(awake.size(), 0);
  std::vector<int> left(awake.size(), kSavedPasses);
  for (const Body* body : awake) {
    const std::size_t island = islands.of(*body);
    if (body->again) again[island] = 1;
    if (!body->joints.empty()) jointed[island] = 1;
    left[island] = std::min(left[island], body->passes);
  }
  bool any = false;
  for (Body* body : awake) {
    const std::size_t island = islands.of(*body);
    if (again[island] == 0) continue;
    body->again = jointed[island] != 0 || left[island] > 0;
    any = any || body->again;
    if (jointed[island] != 0) continue;
    body->passes = left[island] == 0 ? -kStepsWithout : left[island] - (body->again ? 1 : 0);
  }
  return any;
}

bool by_serial(const Body* a, const Body* b) { return a->serial < b->serial; }

}  // namespace

void World::Impl::take_step(std::int64_t tick, std::int64_t count) {
  ode::prepare_thread();
  ++steps;
  moved.clear();
  moved.swap(placed);
  stopped.clear();
  crowded = false;
  if (!awake.empty()) {
    const double step = h * static_cast<double>(count);
    contacts.set_step(step);
    collide();
    std::vector<Vec3> before;
    for (const Body* body : awake) {
      if (count > 1) before.push_back(body->velocity());
    }
    integrate(tick, step);
    if (count > 1) take_back(before, step);
    read_bodies(step);
    const bool slept = let_sleep(awake, contacts, h, static_cast<int>(count));
    if (slept || !stopped.empty()) contacts.put_to_rest();
    list_is_old = true;
  }
  sort_unique(moved);
}

// Each body that an awake body touches is awake too, and has its own pairs tested:
// `awake` grows during the loop.
void World::Impl::collide() {
  contacts.start();
  for (Body* body : awake) {
    for (Geom* geom : body->geoms) {
      follow_body(*geom);
      grid.update(*geom);
    }
    body->overlap = 0.0;
  }
  for (std::size_t i = 0; i < awake.size(); ++i) collide_body(*awake[i]);
  crowded = crowded || contacts.tangled();
  std::sort(awake.begin(), awake.end(), by_serial);
  for (Body* body : awake) give_to_ode(*body);
  has_large_islands = mark_large_islands(awake, contacts.active());
  contacts.make_joints();
}

void World::Impl::collide_body(Body& body) {
  contacts.forget(body);
  for (Geom* geom : body.geoms) {
    grid.query(*geom, [&](Geom& other) {
      if (!may_touch(*geom, other) || other.body->collided == steps) return;
      if (contacts.full() && other.body->dynamic()) {
        crowded = true;
        return;
      }
      // The idle time keeps counting: a body that is only leant on falls asleep with its neighbor.
      if (contacts.collide(*geom, other) && other.body->dynamic()) wake_up(*other.body, awake);
    });
  }
  body.collided = steps;
}

void World::Impl::add_lift() {
  for (Body* body : awake) {
    for (const Weightless& part : body->weightless) {
      const Vec3 at = body->at * part.center;
      const Vec3 lift = -part.mass * gravity;
      dBodyAddForceAtPos(body->ode.get(), lift.x(), lift.y(), lift.z(), at.x(), at.y(), at.z());
    }
  }
}

// Updates that depend on poses and joint positions: springs, speed bounds, directions of drives.
void World::Impl::set_up_joints(double step) {
  for (Body* body : awake) {
    if (body->drive) aim_drive(*body, step);
    for (Joint* joint : body->joints) {
      if (joint->first != body || joint->axes.empty()) continue;
      if (joint->thread != nullptr) aim_thread(*joint);
      if (joint->axes[0].stiffness > 0.0) apply_spring(*joint, step);
      if (joint->motor_force > 0.0 && joint->axes[0].safety) apply_motor(*joint);
    }
  }
}

// The step of the bodies marked `again` is taken once more, from `start`.
void World::Impl::solve_again(const std::vector<BodyState>& start, bool push, const Solve& solve) {
  std::vector<Body*> bodies;
  for (std::size_t i = 0; i < awake.size(); ++i) {
    if (awake[i]->again) {
      bodies.push_back(awake[i]);
      restore(*awake[i], start[i]);
    } else {
      dBodyDisable(awake[i]->ode.get());
    }
  }
  contacts.make_joints_again(push);
  std::vector<Unstable> others = std::move(trouble.unstable);
  erase_if(others, [](const Unstable& unstable) { return unstable.body->again; });
  solve(bodies);
  trouble.unstable.insert(trouble.unstable.end(), others.begin(), others.end());
  for (const Body* body : awake) dBodyEnable(body->ode.get());
}

// The step that friction takes part in gives the normal forces that bound it: it is taken again
// until they agree.
void World::Impl::agree_on_friction(const std::vector<BodyState>& start, const Solve& solve) {
  for (Body* body : awake) gain_passes(*body);
  for (int pass = 0; pass < kPasses && !trouble.never; ++pass) {
    for (Body* body : awake) body->again = false;
    if (!contacts.revise_friction(pass >= kPasses / 2)) return;
    if (!spend_pass(awake, Islands(awake, contacts.active()))) return;
    solve_again(start, true, solve);
  }
}

void World::Impl::integrate(std::int64_t tick, double step) {
  add_lift();
  set_up_joints(step);
  add_gyroscopic_torques(awake, step);
  const Solve solve = [&](const std::vector<Body*>& bodies) {
    const auto first_try = [&](dWorldID ode_world, double part) {
      has_large_islands ? step_by_size(ode_world, bodies, part, seed, tick)
                        : void(dWorldStep(ode_world, part));
    };
    if (!solve_step(world.get(), bodies, step, seed, tick, first_try, &trouble)) ++failed;
  };
  const bool parting = mark_parting(awake, contacts);
  std::vector<BodyState> start;
  for (const Body* body : awake) start.push_back(state_of(*body));
  solve(awake);
  if (parting && !trouble.never) {
    part(awake, start, contacts.fastest(), step, [&] { solve_again(start, false, solve); });
  }
  agree_on_friction(start, solve);
  note_torques(awake, step);
  contacts.finish();
  contacts.remember(tick);
  if (trouble.broken) renew();
  if (trouble.never && trouble.unstable.empty()) {
    for (Body* body : awake) trouble.unstable.push_back({body, "its motion has no solution"});
  }
  for (const Unstable& unstable : trouble.unstable) {
    if (!unstable.body->awake) continue;  // its mechanism has been stopped
    stop(*unstable.body->mechanism, awake);
    stopped.push_back({unstable.body->links.front(), unstable.why});
  }
}

// After a failure within a step ODE's world holds half-done work, which its destructor would step
// on: it is abandoned, and the awake mechanisms are inserted into a new one as they were.
void World::Impl::renew() {
  struct Motion {
    Vec3 velocity, spin;
  };
  std::vector<Motion> motions;
  std::set<Mechanism*> mechanisms;
  for (const Body* body : awake) {
    motions.push_back({body->velocity(), body->spin()});
    mechanisms.insert(body->mechanism);
  }
  for (Mechanism* mechanism : mechanisms) take_out(*mechanism);
  static_cast<void>(world.release());
  static_cast<void>(threading.release());
  make_ode_world();
  for (std::size_t i = 0; i < awake.size(); ++i) {
    give_to_ode(*awake[i]);
    const auto& [v, w] = motions[i];
    dBodySetLinearVel(awake[i]->ode.get(), v.x(), v.y(), v.z());
    dBodySetAngularVel(awake[i]->ode.get(), w.x(), w.y(), w.z());
  }
}

void World::Impl::take_back(const std::vector<Vec3>& before, double step) {
  if (awake.size() != before.size()) return;  // some were stopped
  for (std::size_t i = 0; i < awake.size(); ++i) {
    if (!awake[i]->joints.empty()) continue;
    dBodyID ode = awake[i]->ode.get();
    const Vec3 back = 0.5 * (step - h) * (awake[i]->velocity() - before[i]);
    const Vec3 at = ode::vec(dBodyGetPosition(ode)) - Vec3(back.x(), back.y(), 0.0);
    dBodySetPosition(ode, at.x(), at.y(), at.z());
  }
}

void World::Impl::read_bodies(double step) {
  for (Body* body : awake) {
    if (body->upright) set_upright(*body);
    const Pose at{ode::vec(dBodyGetPosition(body->ode.get())),
                  ode::quat(dBodyGetQuaternion(body->ode.get()))};
    if (at == body->at) continue;
    body->at = at;
    moved.insert(moved.end(), body->links.begin(), body->links.end());
  }
  for (Body* body : awake) {
    for (Joint* joint : body->joints) {
      if (joint->first == body) update_joint(*joint, step);
    }
  }
}

}  // namespace angen::physics
