#include <gtest/gtest.h>

#include "robot.h"

// Readings of the sensors of a robot's own plug-ins: inertia, truth, joints.
namespace angen::robots {
namespace {

const std::string kDrive =
    plugin("diff_drive",
           "<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>"
           "<wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.1</wheelDiameter>"
           "<wheelAcceleration>0.5</wheelAcceleration>");

TEST(Base, AnImuFeelsGravityTurningAndItsCircle) {
  const std::string imu =
      plugin("imu",
             "<bodyName>body</bodyName><topicName>imu</topicName><updateRate>100"
             "</updateRate><xyzOffset>0.1 0 0.1</xyzOffset>",
             "imu");
  Hall hall(robot(kDrive + imu));
  hall.request("imu");
  hall.run(1.0);
  std::vector<double> felt = list(hall.reading("imu"), "acceleration");
  EXPECT_NEAR(felt[2], 9.8, 0.02);
  EXPECT_NEAR(felt[0], 0.0, 0.02);
  hall.command("diff_drive", {0.0, 1.0});
  hall.run(4.0);
  const double start = to_rpy(hall.pose().rotation).z();
  double inwards = 0.0, turning = 0.0;  // means over half a second
  for (int i = 0; i < 50; ++i) {
    hall.run(0.01);
    inwards += list(hall.reading("imu"), "acceleration")[0] / 50;
    turning += list(hall.reading("imu"), "angular_velocity")[2] / 50;
  }
  const double turned = std::remainder(to_rpy(hall.pose().rotation).z() - start, 2 * M_PI);
  EXPECT_NEAR(turning, turned / 0.5, 0.01);
  EXPECT_NEAR(turning, 1.0, 0.1);
  EXPECT_NEAR(inwards, -turning * turning * 0.1, 0.02);
  const std::vector<double> q = list(hall.reading("imu"), "orientation");
  EXPECT_NEAR(std::abs(Quat(q[3], q[0], q[1], q[2]).dot(hall.pose().rotation)), 1.0, 1e-5);
}

TEST(Base, P3dIsWhereItsLinkIs) {
  Hall hall(robot(
      kDrive + plugin("p3d", "<bodyName>bot::left</bodyName><topicName>t</topicName>", "truth")));
  hall.request("p3d");
  hall.run(0.5);
  hall.command("diff_drive", {0.3, 0.0});
  hall.run(2.0);
  const Reading truth = hall.reading("p3d");
  EXPECT_NEAR(list(truth, "position")[0], hall.pose().position.x(), 0.003);
  EXPECT_NEAR(list(truth, "position")[1], 0.15, 0.003);
  EXPECT_NEAR(list(truth, "velocity")[0], 0.3, 0.02);
}

TEST(Base, JointStatesHaveTheJointsThatAreNamed) {
  Hall hall(robot(kDrive + plugin("joint_state_publisher",
                                  "<jointName>right_joint, left_joint</jointName>", "joints")));
  hall.run(0.2);
  const Reading states = hall.reading("joint_states");
  EXPECT_EQ(states.get<std::vector<std::string>>("names"),
            (std::vector<std::string>{"right_joint", "left_joint"}));
  hall.command("diff_drive", {0.2, 0.0});
  hall.run(3.0);
  EXPECT_NEAR(list(hall.reading("joint_states"), "velocities")[0], 0.2 / 0.05, 0.1);
}

TEST(Base, APlanarRobotMovesSidewaysAndTurns) {
  Hall hall(robot(plugin("planar_move", "<odometryRate>50</odometryRate>")));
  hall.run(0.5);
  hall.command("planar_move", {0.0, 0.3, 0.0});
  hall.run(2.0);
  EXPECT_NEAR(hall.pose().position.y(), 0.6, 0.05);
  EXPECT_NEAR(hall.reading("planar_odometry").get<double>("left"), 0.3, 0.03);
  hall.command("planar_move", {0.0, 0.0, 0.5});
  hall.run(2.0);
  EXPECT_NEAR(to_rpy(hall.pose().rotation).z(), 1.0, 0.1);
}

TEST(Base, AnUnknownBodyIsNamed) {
  const std::string text = robot(kDrive + plugin("imu", "<bodyName>head</bodyName>", "imu"));
  try {
    Hall hall(text);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("model 'bot' has no link 'head'; known are body"),
              std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(Hall(text, true).warns("has no link 'head'"));
}

}  // namespace
}  // namespace angen::robots
