#include "physics/solver.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace angen::physics {
namespace {

/// Two boxes above each other, the upper one touching the lower one.
struct Pile {
  Pile() {
    ode::prepare_thread();
    world.reset(dWorldCreate());
    dWorldSetGravity(world.get(), 0, 0, -9.81);
    for (int i = 0; i < 2; ++i) {
      Body& body = bodies[i];
      body.ode.reset(dBodyCreate(world.get()));
      dMass mass;
      dMassSetBoxTotal(&mass, 2.0 + i, 1, 1, 1);
      dBodySetMass(body.ode.get(), &mass);
      dBodySetPosition(body.ode.get(), 0, 0, i);
      awake.push_back(&body);
    }
    dBodySetAngularVel(bodies[1].ode.get(), 0.1, 0.2, 0.3);
    dBodyAddForce(bodies[0].ode.get(), 5, 6, 7);
    joint.reset(dJointCreateBall(world.get(), nullptr));
    dJointAttach(joint.get(), bodies[0].ode.get(), bodies[1].ode.get());
    dJointSetBallAnchor(joint.get(), 0.5, 0, 0.5);
  }
  Vec3 velocity(int i) const { return ode::vec(dBodyGetLinearVel(bodies[i].ode.get())); }
  Vec3 position(int i) const { return ode::vec(dBodyGetPosition(bodies[i].ode.get())); }

  ode::WorldHandle world;
  Body bodies[2];
  ode::JointHandle joint;
  std::vector<Body*> awake;
};

TEST(Solver, TakesAFailedStepAgainFromItsStart) {
  Pile failing;
  const bool good =
      solve_step(failing.world.get(), failing.awake, 1e-3, 3, 4, [](dWorldID w, double h) {
        dWorldStep(w, 10 * h);
        dMessage(d_ERR_LCP, "LCP internal error, s <= 0 (s=%.4e)", 0.0);
      });
  EXPECT_FALSE(good);
  // As if the other solver had been used at once.
  Pile other;
  EXPECT_FALSE(solve_step(other.world.get(), other.awake, 1e-3, 3, 4, [](dWorldID, double) {
    dMessage(d_ERR_LCP, "LCP internal error, s <= 0 (s=%.4e)", 0.0);
  }));
  Pile right;
  EXPECT_TRUE(solve_step(right.world.get(), right.awake, 1e-3, 3, 4));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(failing.velocity(i), other.velocity(i));
    EXPECT_EQ(failing.position(i), other.position(i));
    EXPECT_NEAR((failing.velocity(i) - right.velocity(i)).norm(), 0.0, 1e-3);
  }
  EXPECT_GT(failing.velocity(0).norm(), 1e-3);
}

TEST(Solver, TakesAStepAgainThatEndsNowhere) {
  Pile pile;
  EXPECT_FALSE(solve_step(pile.world.get(), pile.awake, 1e-3, 3, 4, [&](dWorldID, double) {
    dBodySetLinearVel(pile.bodies[0].ode.get(), NAN, 0, 0);
  }));
  EXPECT_TRUE(pile.velocity(0).allFinite());
  EXPECT_TRUE(pile.position(1).allFinite());
}

TEST(Solver, StepsEachBodyByTheSolverOfItsSize) {
  const auto stepped = [](bool iterated) {
    Pile pile;
    Body apart;
    apart.ode.reset(dBodyCreate(pile.world.get()));
    dBodySetAngularVel(apart.ode.get(), 1, 2, 3);
    pile.awake.push_back(&apart);
    for (Body& body : pile.bodies) body.iterated = iterated;
    apart.iterated = !iterated;
    step_by_size(pile.world.get(), pile.awake, 1e-2, 3, 4);
    for (const Body* body : pile.awake) EXPECT_TRUE(dBodyIsEnabled(body->ode.get()));
    EXPECT_NEAR(ode::vec(dBodyGetLinearVel(apart.ode.get())).z(), -0.0981, 1e-9);
    return std::array<Vec3, 2>{pile.velocity(0), pile.velocity(1)};
  };
  Pile iterated;
  EXPECT_FALSE(solve_step(iterated.world.get(), iterated.awake, 1e-2, 3, 4, [](dWorldID, double) {
    dMessage(d_ERR_LCP, "LCP internal error, s <= 0 (s=%.4e)", 0.0);
  }));
  Pile exact;
  dWorldStep(exact.world.get(), 1e-2);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(stepped(true)[i], iterated.velocity(i));
    EXPECT_EQ(stepped(false)[i], exact.velocity(i));
    EXPECT_NE(iterated.velocity(i), exact.velocity(i));
  }
}

TEST(Solver, OtherMessagesAreNoFailure) {
  Pile pile;
  EXPECT_TRUE(solve_step(pile.world.get(), pile.awake, 1e-3, 3, 4, [](dWorldID w, double h) {
    dMessage(0, "hello");
    dWorldStep(w, h);
  }));
}

}  // namespace
}  // namespace angen::physics
