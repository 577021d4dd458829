#include "record/action_line.h"

#include <gtest/gtest.h>

#include "angen_sim/record/logged.h"

namespace angen::record {
namespace {

TEST(ActionLine, ARunWithEveryEditIsReplayedToTheSameBits) {
  const Folder folder;
  Session session(folder);
  const auto edit = [&](sim::Edit what) {
    auto answer = session.simulation.post(sim::Action(std::move(what)));
    session.run(0.3);
    const sim::Outcome outcome = answer.get();
    EXPECT_TRUE(outcome.ok) << outcome.message;
  };
  const Vec3 third = Vec3::Constant(1.0 / 3.0);
  const std::string light = "<light name='l' type='point'><pose>0 0 2 0 0 0</pose></light>";
  sim::SetLinkProperties link{"brick::link", {}, true};
  link.inertial.mass = 1.0 / 3.0;
  link.inertial.moment *= 0.01;
  sim::SetPhysics physics{session.simulation.snapshot()->structure->physics, {0, 0.1, -3.0}};
  physics.physics.iterations = 33;
  edit(sim::SetModelState{"brick", {"it", {third, from_rpy(0.1, 0.2, 0.3)}, third, third}});
  edit(sim::SetLinkState{"brick::link", {"", {{-1, 1, 1}, Quat::Identity()}, third, third}});
  edit(sim::SetJoints{"hall_door", {"hinge"}, {-1.0 / 3.0}});
  edit(sim::PushLink{"brick::link", "floor::link", third, third, third, {kSecond, -1}});
  edit(sim::PushJoint{"hall_door::hinge", -2.0 / 3.0, {0, kSecond / 3}});
  edit(link);
  edit(sim::SetJointProperties{"hall_door::hinge", {1.0 / 3.0}, {}, {-1.5}, 3.0, 0.1});
  edit(physics);
  edit(sim::AddLight{load::light(light, "extra", {third, Quat::Identity()}), light});
  edit(sim::SetLight{"extra", {0.3F, 0.2F, 0.1F}, false, third, {third, Quat::Identity()}});
  edit(sim::ClearPushes{"brick::link"});
  edit(sim::DeleteLight{"extra"});
  session.run(1.0);
  session.end();
  const Replay replay = replayed(folder.log());
  EXPECT_EQ(replay.actions(), 12U);
  EXPECT_GE(replay.compared(), 4U);
  EXPECT_EQ(replay.mismatch(), "");
}

TEST(ActionLine, WhatOnlyReadsIsInNoLog) {
  const Folder folder;
  Session session(folder);
  const auto observed = std::make_shared<sim::Observed>();
  session.simulation.post(sim::Observe{{{"brick"}, {}}, observed});
  session.run(1.2);
  session.end();
  EXPECT_EQ(observed->entities.size(), 1U);
  EXPECT_EQ(replayed(folder.log()).actions(), 0U);
}

}  // namespace
}  // namespace angen::record
