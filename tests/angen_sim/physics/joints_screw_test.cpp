// Screws: joints that turn and move along their axis at once.
#include <gtest/gtest.h>

#include <cmath>

#include "models.h"

namespace angen::physics::testing {
namespace {

using Type = desc::Joint::Type;

/// A nut of 2 kg, with its middle at `middle`, on a thread along `axis` through `anchor`.
desc::Model nut(double lead, const std::string& parent = "world", const Vec3& axis = Vec3::UnitZ(),
                const Vec3& middle = Vec3::Zero(), const Vec3& anchor = Vec3::Zero()) {
  desc::Model model =
      model_of("nut", {ghost_link("nut", 2.0, {0.2, 0.3, 0.1}, {middle, Quat::Identity()})});
  if (parent != "world") model.links.push_back(ghost_link(parent, 3.0, {0.1, 0.1, 0.6}));
  model.joints = {joint_of(Type::kScrew, parent, "nut", axis, anchor)};
  model.joints[0].axes.resize(1);
  model.joints[0].axes[0].xyz = axis;
  model.joints[0].lead = lead;
  return model;
}

double moment_of(const desc::Link& link) { return link.inertial.moment(2, 2); }  // about z

/// J, of a link of a diagonal inertia, without gravity.
double energy_of(const LinkState& state, const desc::Link& link) {
  const Vec3 spin = state.pose.rotation.conjugate() * state.angular_velocity;
  return 0.5 * link.inertial.mass * state.linear_velocity.squaredNorm() +
         0.5 * spin.dot(link.inertial.moment * spin);
}

TEST(Screw, FallsAsSlowlyAsItsThreadLetsIt) {
  for (const double lead : {0.002, -0.05, 0.3}) {  // m/rad
    TestWorld world;
    const desc::Model model = nut(lead);
    const ModelId id = world.add(model);
    const LinkId link = world.only_link(id);
    const JointId joint = world.joints(id)[0];
    const double carried = moment_of(model.links[0]) + 2.0 * lead * lead;  // kg m^2
    const double turn = -2.0 * 9.81 * lead / carried;                      // rad/s^2
    double most = 0.0;
    for (int i = 1; i <= 1000; ++i) {
      world.run(kStep);
      const LinkState at = world.link(link);
      EXPECT_NEAR(at.pose.position.z(), lead * world.joint(joint).position, 1e-6);
      const double potential = 2.0 * 9.81 * at.pose.position.z();
      most = std::max(most, energy_of(at, model.links[0]) + potential);
    }
    // The integrator is semi-implicit: a t^2 / 2 + a t h / 2.
    EXPECT_NEAR(world.joint(joint).position, 0.5 * turn * (1.0 + kStep), 1e-4 * std::abs(turn));
    EXPECT_NEAR(world.joint(joint).velocity, turn, 1e-4 * std::abs(turn));
    const double height = world.link(link).pose.position.z();
    const double energy = energy_of(world.link(link), model.links[0]) + 2.0 * 9.81 * height;
    printf("screw of %.3f m/rad: %.5f rad, %.2g of the energy is lost, %.2g J at most\n", lead,
           world.joint(joint).position, energy / (2.0 * 9.81 * height), most);
    EXPECT_NEAR(energy / (2.0 * 9.81 * height), 0.0, 2.0 * kStep);  // that of a fall by h g v
    EXPECT_LT(most, 1e-3);
  }
}

TEST(Screw, ATorquePushesAlongTheThread) {
  const double lead = 0.1;
  TestWorld world({}, Vec3::Zero());
  const desc::Model model = nut(lead, "world", Vec3(1.0, 2.0, -1.0).normalized());
  const JointId joint = world.joints(world.add(model))[0];
  const Vec3 axis = model.joints[0].axes[0].xyz;
  const double carried =
      axis.dot(model.links[0].inertial.moment * axis) + 2.0 * lead * lead;  // at the start
  world.add_force(joint, 0.7);
  world.run(kStep);
  EXPECT_NEAR(world.joint(joint).velocity, 0.7 / carried * kStep, 1e-4 * 0.7 / carried * kStep);
  // The wrench on the parent: all that moves the nut along comes from its thread.
  const double along = -axis.dot(world.wrench(joint).force);
  EXPECT_NEAR(along, 2.0 * lead * 0.7 / carried, 1e-3 * 2.0 * lead * 0.7 / carried);
}

TEST(Screw, BetweenTwoFreeBodiesKeepsEnergyAndMomenta) {
  TestWorld world({}, Vec3::Zero());
  const desc::Model model = nut(0.08, "rod", Vec3::UnitZ(), {0.05, -0.03, 0.1}, {0.01, 0.02, 0.0});
  const ModelId id = world.add(model);
  const LinkId one = world.links(id)[0];
  const LinkId two = world.links(id)[1];
  const JointId joint = world.joints(id)[0];
  for (int i = 0; i < 100; ++i) {
    world.add_force(joint, 0.2);
    world.run(kStep);
  }
  const auto energy = [&] {
    return energy_of(world.link(one), model.links[0]) + energy_of(world.link(two), model.links[1]);
  };
  const double start = energy();
  const double speed = world.joint(joint).velocity;
  ASSERT_GT(speed, 0.5);
  double drift = 0.0;
  for (int i = 0; i < 3000; ++i) {
    world.run(kStep);
    const Pose rod = world.pose(two);
    const Vec3 anchor = rod * Vec3(0.01, 0.02, 0.0);
    const Vec3 on_nut = world.pose(one) * Vec3(-0.04, 0.05, -0.1);
    const Vec3 apart = rod.rotation.conjugate() * (on_nut - anchor);
    drift = std::max(drift, (apart - Vec3(0, 0, 0.08 * world.joint(joint).position)).norm());
  }
  const Vec3 momentum =
      2.0 * world.link(one).linear_velocity + 3.0 * world.link(two).linear_velocity;
  printf("screw between free bodies: energy %.6f of %.6f J, %.2g m off the thread\n", energy(),
         start, drift);
  EXPECT_NEAR(energy(), start, 0.01 * start);
  EXPECT_LT(momentum.norm(), 1e-6);
  EXPECT_LT(drift, 1e-4);
}

TEST(Screw, HasStopsMotorsFrictionAndAPositionAtTheStart) {
  const double lead = 0.01;
  TestWorld world;
  desc::Model model = nut(lead);
  model.joints[0].axes[0].initial_position = 7.0;
  model.joints[0].axes[0].upper = 9.0;
  model.joints[0].axes[0].friction = 1.05 * 2.0 * 9.81 * lead;
  const ModelId id = world.add(model);
  const LinkId link = world.only_link(id);
  const JointId joint = world.joints(id)[0];
  EXPECT_NEAR(world.pose(link).position.z(), 7.0 * lead, 1e-9);
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).position, 7.0, 1e-3) << "its friction carries the weight";
  world.set_motor(joint, 2.0, 100.0);
  world.run(0.5);
  EXPECT_NEAR(world.joint(joint).position, 8.0, 0.01);
  EXPECT_NEAR(world.joint(joint).effort, 2.0 * 9.81 * lead, 1e-4);
  world.run(1.0);
  EXPECT_NEAR(world.joint(joint).position, 9.0, 1e-3);
  EXPECT_NEAR(world.pose(link).position.z(), 9.0 * lead, 1e-5);
  world.set_motor(joint, 0.0, 0.0);
  world.add_force(joint, 0.5);
  world.run(kStep);
  EXPECT_NEAR(world.wrench(joint).force.z(), -2.0 * 9.81, 0.1) << "what the nut weighs";
  world.arrange(id, {2.0 * M_PI});
  EXPECT_NEAR(world.pose(link).position.z(), 2.0 * M_PI * lead, 1e-7);
  world.set_motor(joint, 0.0, 0.0);
  world.run(0.1);
  EXPECT_NEAR(world.joint(joint).position, 2.0 * M_PI, 1e-3);
}

}  // namespace
}  // namespace angen::physics::testing
