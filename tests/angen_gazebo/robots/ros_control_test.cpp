#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string control(const std::string& interface) {
  return "<plugin name='c' "
         "filename='libgazebo_ros_control.so'><robotNamespace>/bot</robotNamespace>"
         "<transmission><joint>left_joint</joint><hardwareInterface>hardware_interface/" +
         interface + "JointInterface</hardwareInterface></transmission></plugin>";
}

double angle(const Hall& hall) { return to_rpy(hall.pose("bot::left").rotation).y(); }

TEST(RosControl, APositionIsHeldUnderLoadAndReached) {
  Hall hall(arms(control("Position")), true);
  EXPECT_TRUE(hall.warnings.empty());
  hall.run(1.0);
  EXPECT_NEAR(angle(hall), 0.0, 0.001) << "held where it is";
  hall.command("joint_command", {0.7}, "bot_left_joint");
  hall.run(1.0);
  EXPECT_NEAR(angle(hall), 0.7, 0.001);
  EXPECT_NEAR(list(hall.reading("controlled_joints"), "positions")[0], 0.7, 0.001);
  hall.run(3.0);
  EXPECT_NEAR(angle(hall), 0.7, 0.001);
}

TEST(RosControl, AJointThatAServiceSetsStaysThereUntilItIsCommanded) {
  Hall hall(arms(control("Position")), true);
  hall.run(0.1);
  const auto set = [&](double position) {
    hall.simulation.post(sim::Edit(sim::SetJoints{"bot", {"left_joint"}, {position}}));
    hall.run(1.0);
  };
  set(0.6);
  EXPECT_NEAR(angle(hall), 0.6, 0.001);
  hall.command("joint_command", {0.2}, "bot_left_joint");
  set(0.6);
  EXPECT_NEAR(angle(hall), 0.2, 0.001);
}

TEST(RosControl, AVelocityIsKept) {
  Hall hall(arms(control("Velocity")), true);
  hall.command("joint_command", {0.25}, "bot_left_joint");
  hall.run(2.0);
  EXPECT_NEAR(angle(hall), 0.5, 0.005);
  hall.command("joint_command", {0.0}, "bot_left_joint");
  hall.run(1.0);
  EXPECT_NEAR(angle(hall), 0.5, 0.005);
}

TEST(RosControl, AnEffortBalancesItsLoad) {
  const std::string damped = "<dynamics><damping>1</damping></dynamics>";
  Hall hall(arms(control("Effort"), damped), true);
  hall.command("joint_command", {-0.5 * 0.2 * 9.8}, "bot_left_joint");
  hall.run(12.0);
  // Half of the torque of the level arm holds it at 60 degrees.
  EXPECT_NEAR(angle(hall), M_PI / 3.0, 0.02);
}

TEST(RosControl, AnEffortEndsAtTheJointsLimit) {
  Hall hall(arms(control("Effort"), "<limit><effort>0.5</effort></limit>"), true);
  hall.command("joint_command", {-10.0}, "bot_left_joint");
  hall.run(0.1);
  EXPECT_DOUBLE_EQ(hall.state("bot_left_joint").get<double>("command"), -10.0);
  EXPECT_NEAR(hall.state("bot_left_joint").get<double>("effort"), -0.5, 0.01);
  EXPECT_GT(angle(hall), 0.01) << "less than its weight: it falls";
}

TEST(RosControl, PositionsInASequenceAreAMotion) {
  Hall hall(arms(control("Position")), true);
  hall.run(0.1);
  for (int i = 1; i <= 400; ++i) {
    hall.command("joint_command", {0.001 * i}, "bot_left_joint");
    hall.run(0.001);
    EXPECT_NEAR(angle(hall), 0.001 * i, 0.002) << "1 rad/s, without the lag of 20 ms";
  }
  hall.run(0.1);
  EXPECT_NEAR(angle(hall), 0.4, 0.001) << "it stops with its commands";
}

// As in robots whose drive needs no controllers: these joints get no commands here.
TEST(RosControl, AnotherDriveOfTheRobotLeadsItsWheels) {
  std::string both = "<plugin name='c' filename='libgazebo_ros_control.so'>";
  for (const char* joint : {"left_joint", "right_joint"}) {
    both += "<transmission><joint>" + std::string(joint) +
            "</joint><hardwareInterface>VelocityJointInterface</hardwareInterface></transmission>";
  }
  both += "</plugin>";
  const std::string drive =
      plugin("diff_drive",
             "<wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.1</wheelDiameter>", "d");
  for (const std::string& plugins : {both + drive, drive + both}) {
    Hall hall(robot(plugins), true);
    hall.run(0.5);
    hall.command("diff_drive", {0.3, 0.0});
    hall.run(2.0);
    EXPECT_NEAR(hall.pose().position.x(), 0.6, 0.03);
  }
}

TEST(RosControl, WithoutTransmissionsItSaysWhatIsMissing) {
  Hall hall(arms("<plugin name='c' filename='libgazebo_ros_control.so'/>"), true);
  EXPECT_TRUE(hall.warns("needs the <transmission>s of a URDF"));
}

}  // namespace
}  // namespace angen::robots
