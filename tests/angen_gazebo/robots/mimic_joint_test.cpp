#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string mimic(const std::string& more) {
  return "<plugin name='m' filename='libroboticsgroup_gazebo_mimic_joint_plugin.so'><joint>"
         "left_joint</joint><mimicJoint>right_joint</mimicJoint>" +
         more + "</plugin>";
}

TEST(MimicJoint, IsWhereItsMultiplierAndOffsetSay) {
  const std::string damped = "<dynamics><damping>0.5</damping></dynamics>";
  Hall hall(arms(mimic("<multiplier>-0.5</multiplier><offset>0.2</offset>"), damped));
  double least = 0.0, most = 0.0;
  for (int i = 0; i < 30; ++i) {
    hall.run(0.1);
    const double leads = angle(hall, "left");
    EXPECT_NEAR(angle(hall, "right"), -0.5 * leads + 0.2, 0.01) << i;
    least = std::min(least, leads);
    most = std::max(most, leads);
  }
  EXPECT_GT(most - least, 1.0) << "the leader swings";
}

TEST(MimicJoint, WithAPidItHasNoMoreThanItsEffort) {
  Hall hall(arms(mimic("<hasPID>true</hasPID><maxEffort>0.1</maxEffort>")));
  hall.run(3.0);  // 0.1 N m do not carry 1 kg at 0.2 m
  EXPECT_GT(angle(hall, "right"), 0.5);
}

TEST(MimicJoint, NamesTheJointThatIsMissing) {
  Hall hall(arms("<plugin name='m' filename='libroboticsgroup_gazebo_mimic_joint_plugin.so'><joint>"
                 "missing</joint><mimicJoint>right_joint</mimicJoint></plugin>"),
            true);
  EXPECT_TRUE(hall.warns("no joint 'missing'"));
}

}  // namespace
}  // namespace angen::robots
