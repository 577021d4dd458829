#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

const std::string kPlugin = plugin("joint_pose_trajectory", "<topicName>t</topicName>");

TEST(JointPoseTrajectory, LeadsJointsThroughItsPointsAndHoldsTheLast) {
  Hall hall(arms(kPlugin, "<limit><lower>-1.5</lower><upper>1.5</upper></limit>"));
  hall.command("joint_trajectory",
               {0.0, /**/ 1.0, 0.4, -0.2, /**/ 2.0, 0.4, 0.6, /**/ 3.0, -0.5, 0.6}, "bot",
               "left_joint right_joint");
  hall.run(1.0);
  EXPECT_NEAR(angle(hall, "left"), 0.4, 0.003);
  EXPECT_NEAR(angle(hall, "right"), -0.2, 0.003);
  EXPECT_TRUE(hall.state("bot").get<bool>("follows"));
  hall.run(0.5);
  EXPECT_NEAR(angle(hall, "left"), 0.4, 0.003);
  EXPECT_NEAR(angle(hall, "right"), 0.2, 0.003);
  hall.run(4.0);
  EXPECT_NEAR(angle(hall, "left"), -0.5, 0.003);
  EXPECT_NEAR(angle(hall, "right"), 0.6, 0.003);
  EXPECT_FALSE(hall.state("bot").get<bool>("follows"));
}

TEST(JointPoseTrajectory, RejectsWhatFitsNoJoints) {
  Hall hall(arms(kPlugin));
  const auto answer = [&](const std::vector<double>& values, const std::string& names) {
    auto outcome =
        hall.simulation.post(sim::ToDevice{"joint_trajectory", "bot", {names, values, "", 0.0}});
    hall.run(0.001);
    return outcome.get().message;
  };
  EXPECT_NE(answer({0.0, 1.0, 0.4}, "elbow").find("no joint 'elbow'"), std::string::npos);
  EXPECT_NE(answer({0.0, 1.0, 0.4, 0.3}, "left_joint").find("at least once"), std::string::npos);
  EXPECT_NE(answer({0.0, 2.0, 0.4, 1.0, 0.3}, "left_joint").find("ascend"), std::string::npos);
  EXPECT_NE(answer({0.0, -1.0, 0.3}, "left_joint").find("negative"), std::string::npos);
  EXPECT_NE(answer({}, "").find("names none"), std::string::npos);
}

}  // namespace
}  // namespace angen::robots
