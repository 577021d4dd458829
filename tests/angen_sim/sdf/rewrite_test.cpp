#include "sdf/rewrite.h"

#include "angen_sim/sdf/texts.h"

namespace angen::load {
namespace {

const std::string kDoor =
    "<model name='d'><link name='a'><light name='l' type='spot'><pose>0 0 1 0 0 0</pose>"
    "<direction>0 0 -1</direction></light></link>"
    "<link name='b'><inertial><mass>2</mass><pose relative_to='a'>0 0 0.1 0 0 0</pose></inertial>"
    "</link><joint name='hinge' type='revolute'><parent>a</parent><child>b</child><axis>"
    "<xyz>1 0 0</xyz><limit><lower>-1.57</lower><upper>0.5</upper><effort>7</effort></limit>"
    "</axis></joint><joint name='free' type='continuous'><parent>a</parent><child>c</child><axis>"
    "<xyz>1 0 0</xyz></axis></joint><link name='c'/></model>";

/// A world of one model, saved after its description was changed.
std::string saved(const desc::World& world, const desc::Model& now) {
  ModelState state{&now, now.pose, {}, {}};
  state.read = &world.models[0];
  return save(world, {state});
}

void change(desc::Model& model, const std::string& scope = "") {
  for (desc::Link& link : model.links) {
    if (link.name == scope + "a") {
      link.gravity = false;
      link.lights[0].diffuse = {0.25F, 0.5F, 1.0F};
      link.lights[0].direction = {0.0, 1.0, 0.0};
      link.lights[0].cast_shadows = false;
    }
    if (link.name != scope + "b") continue;
    link.inertial.mass = 3.5;
    link.inertial.pose = {{0.1, 0.2, 0.3}, from_rpy(0.1, 0.2, 0.3)};
    link.inertial.moment << 1.5, 0.1, 0.2, 0.1, 1.25, 0.3, 0.2, 0.3, 1.0;
  }
  for (desc::Joint& joint : model.joints) {
    if (joint.name == scope + "free") joint.axes[0].upper = 2.0;
    if (joint.name != scope + "hinge") continue;
    joint.axes[0].damping = 0.75;
    joint.axes[0].lower = -0.5;
  }
}

void expect_changed(const desc::Model& now, const desc::Model& again) {
  ASSERT_EQ(again.links.size(), now.links.size());
  for (std::size_t i = 0; i < now.links.size(); ++i) {
    EXPECT_EQ(again.links[i].gravity, now.links[i].gravity);
    EXPECT_EQ(again.links[i].inertial.mass, now.links[i].inertial.mass);
    expect_near(again.links[i].inertial.pose, now.links[i].inertial.pose);
    EXPECT_EQ(again.links[i].inertial.moment, now.links[i].inertial.moment);
    ASSERT_EQ(again.links[i].lights.size(), now.links[i].lights.size());
    for (std::size_t k = 0; k < now.links[i].lights.size(); ++k) {
      EXPECT_EQ(again.links[i].lights[k].diffuse, now.links[i].lights[k].diffuse);
      expect_near(again.links[i].lights[k].direction, now.links[i].lights[k].direction);
      EXPECT_FALSE(again.links[i].lights[k].cast_shadows);
    }
  }
  ASSERT_EQ(again.joints.size(), now.joints.size());
  for (std::size_t i = 0; i < now.joints.size(); ++i) {
    EXPECT_EQ(again.joints[i].axes[0].damping, now.joints[i].axes[0].damping);
    EXPECT_EQ(again.joints[i].axes[0].lower, now.joints[i].axes[0].lower);
    EXPECT_EQ(again.joints[i].axes[0].upper, now.joints[i].axes[0].upper);
    EXPECT_EQ(again.joints[i].axes[0].effort, now.joints[i].axes[0].effort);
  }
}

TEST(Rewrite, LinksAndJointsAreSavedAsTheyAreNow) {
  const desc::World world = read(in_world(kDoor));
  desc::Model now = world.models[0];
  change(now);
  expect_changed(now, read(saved(world, now)).models[0]);
}

TEST(Rewrite, AnIncludedModelIsWrittenOut) {
  const Folder folder;
  folder.model("door", sdf(kDoor, "1.7"));
  const desc::World world =
      read(in_world("<include><uri>model://door</uri><name>x</name></include>"), folder.paths());
  desc::Model now = world.models[0];
  change(now);
  const std::string text = saved(world, now);
  EXPECT_EQ(text.find("<include"), std::string::npos) << text;
  expect_changed(now, read(text, folder.paths()).models[0]);
}

TEST(Rewrite, PartsOfNestedModelsAreFound) {
  const desc::World world = read(in_world("<model name='outer'>" + kDoor + "</model>", "1.7"));
  desc::Model now = world.models[0];
  change(now, "d::");
  expect_changed(now, read(saved(world, now)).models[0]);
}

TEST(Rewrite, WhatStaysIsLeftAsItIsWritten) {
  const desc::World world = read(in_world(kDoor));
  const ModelState state{&world.models[0], world.models[0].pose, {}, {}};
  EXPECT_EQ(saved(world, world.models[0]), save(world, {state}));
}

// A service may set it; a file that holds it is an error for a strict model.
TEST(Rewrite, AnInertiaThatNoBodyHasLoadsAgain) {
  const desc::World world = read(in_world(kDoor));
  desc::Model now = world.models[0];
  now.links[1].inertial.moment = Vec3(0.1, 0.1, 1.0).asDiagonal();
  const desc::World again = read(saved(world, now));
  EXPECT_NEAR(again.models[0].links[1].inertial.moment(0, 0), 0.5, 1e-9);
  EXPECT_FALSE(again.warnings.empty());
}

TEST(Rewrite, PhysicsAndGravityAreSavedAsTheyAreNow) {
  for (const char* before :
       {"", "<gravity>0 0 -5</gravity>",
        "<physics type='ode' name='a'><max_step_size>0.002</max_step_size></physics>"
        "<physics type='ode' name='b' default='true'><max_step_size>0.004</max_step_size><ode>"
        "<constraints><erp>0.3</erp></constraints></ode></physics>"}) {
    const desc::World world = read(in_world(before));
    WorldState now{world.physics, {0.5, 0.0, -1.625}, {}};
    now.physics.iterations = 77;
    now.physics.erp = 0.4;
    now.physics.cfm = 1e-6;
    now.physics.contact_max_correcting_vel = 3.0;
    now.physics.contact_surface_layer = 0.002;
    const desc::World again = read(save(world, {}, now));
    EXPECT_EQ(again.gravity, now.gravity);
    EXPECT_EQ(again.physics.step, world.physics.step);
    EXPECT_EQ(again.physics.iterations, 77);
    EXPECT_EQ(again.physics.erp, 0.4);
    EXPECT_EQ(again.physics.cfm, 1e-6);
    EXPECT_EQ(again.physics.contact_max_correcting_vel, 3.0);
    EXPECT_EQ(again.physics.contact_surface_layer, 0.002);
  }
}

}  // namespace
}  // namespace angen::load
