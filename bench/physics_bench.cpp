// Doors through `physics`, with as many hinges in bare ODE beside: one leaf a door, one motor each.
#include <benchmark/benchmark.h>
#include <ode/ode.h>

#include <cmath>
#include <string>
#include <vector>

#include "physics/world.h"

namespace angen::bench {
namespace {

constexpr double kStep = 1e-3;
constexpr double kSize[3] = {0.8, 0.04, 2.0};
constexpr double kMass = 40.0;

double target(int tick) { return -0.75 + 0.7 * std::sin(0.002 * tick); }
double torque(double target, double angle, double rate) {
  return 200.0 * (target - angle) - 50.0 * rate;
}

desc::Model door(int number) {
  desc::Model model;
  model.name = "door" + std::to_string(number);
  model.pose.position = {2.0 * number, 0.0, 0.0};
  desc::Link leaf;
  leaf.name = "leaf";
  leaf.inertial.mass = kMass;
  leaf.inertial.pose.position = {0.5 * kSize[0], 0.0, 1.01};
  leaf.inertial.moment = (kMass * Vec3(0.34, 0.387, 0.053)).asDiagonal();
  desc::Collision box;
  box.name = "collision";
  box.pose = leaf.inertial.pose;
  box.shape.type = Shape::Type::kBox;
  box.shape.size = {kSize[0], kSize[1], kSize[2]};
  leaf.collisions.push_back(box);
  model.links.push_back(leaf);
  desc::Joint hinge;
  hinge.name = "hinge";
  hinge.type = desc::Joint::Type::kRevolute;
  hinge.parent = "world";
  hinge.child = "leaf";
  hinge.axes.emplace_back();
  model.joints.push_back(hinge);
  return model;
}

struct Doors {
  explicit Doors(int count) : world({}, {0.0, 0.0, -9.81}, 1) {
    desc::Model floor = door(0);
    floor.name = "floor";
    floor.is_static = true;
    floor.joints.clear();
    floor.links[0].collisions[0].shape.size = {2.0 * count + 4.0, 4.0, 0.2};
    floor.links[0].collisions[0].pose.position = {1.0 * count, 0.0, -0.1};
    world.add(floor);
    for (int i = 0; i < count; ++i) hinges.push_back(world.joints(world.add(door(i)))[0]);
  }

  physics::World world;
  std::vector<physics::JointId> hinges;
};

void doors_awake(benchmark::State& state) {
  Doors doors(static_cast<int>(state.range(0)));
  int tick = 0;
  for (auto _ : state) {
    for (const physics::JointId hinge : doors.hinges) {
      const physics::JointState s = doors.world.joint(hinge);
      doors.world.add_force(hinge, torque(target(tick), s.position, s.velocity));
    }
    doors.world.step(tick++);
  }
}
BENCHMARK(doors_awake)->Arg(12)->Arg(120);

void doors_asleep(benchmark::State& state) {
  Doors doors(static_cast<int>(state.range(0)));
  int tick = 0;
  for (const physics::JointId hinge : doors.hinges) doors.world.set_motor(hinge, 0.0, 20.0);
  while (doors.world.awake_count() > 0) doors.world.step(tick++);
  for (auto _ : state) doors.world.step(tick++);
}
BENCHMARK(doors_asleep)->Arg(12)->Arg(120);

void doors_in_bare_ode(benchmark::State& state) {
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  dWorldSetGravity(world, 0.0, 0.0, -9.81);
  std::vector<dJointID> hinges;
  for (int i = 0; i < state.range(0); ++i) {
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetBoxTotal(&mass, kMass, kSize[0], kSize[1], kSize[2]);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, 2.0 * i + 0.5 * kSize[0], 0.0, 1.01);
    hinges.push_back(dJointCreateHinge(world, nullptr));
    dJointAttach(hinges.back(), body, nullptr);
    dJointSetHingeAnchor(hinges.back(), 2.0 * i, 0.0, 0.0);
    dJointSetHingeAxis(hinges.back(), 0.0, 0.0, 1.0);
  }
  int tick = 0;
  for (auto _ : state) {
    for (const dJointID hinge : hinges) {
      dJointAddHingeTorque(
          hinge, torque(target(tick), dJointGetHingeAngle(hinge), dJointGetHingeAngleRate(hinge)));
    }
    dWorldStep(world, kStep);
    ++tick;
  }
  dWorldDestroy(world);
}
BENCHMARK(doors_in_bare_ode)->Arg(12)->Arg(120);

}  // namespace
}  // namespace angen::bench

BENCHMARK_MAIN();
