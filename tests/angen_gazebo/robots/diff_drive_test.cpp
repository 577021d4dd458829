#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

std::string drive(const std::string& more = "") {
  return plugin("diff_drive",
                "<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint>"
                "<wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.1</wheelDiameter>"
                "<wheelAcceleration>1</wheelAcceleration><updateRate>50</updateRate>" +
                    more);
}

TEST(DiffDrive, GoesWhereItsOdometrySays) {
  Hall hall(robot(drive()));
  hall.run(0.5);
  const Vec3 start = hall.pose().position;
  hall.command("diff_drive", {0.4, 0.0});
  hall.run(5.0);
  const Vec3 went = hall.pose().position - start;
  EXPECT_NEAR(went.x(), 0.4 * 5.0 - 0.4 * 0.4 / 2.0, 0.02);  // after a ramp of 0.4 s
  const Reading odometry = hall.reading("odometry");
  EXPECT_NEAR(list(odometry, "position")[0], hall.pose().position.x(), 0.4 * 0.002);
  EXPECT_NEAR(odometry.get<double>("forward"), 0.4, 0.01);
  EXPECT_EQ(odometry.stamp % (kSecond / 50), 0);
}

TEST(DiffDrive, HasNoTimeoutAndStopsWhenToldTo) {
  Hall hall(robot(drive()));
  hall.command("diff_drive", {0.2, 0.0});
  hall.run(3.0);
  EXPECT_NEAR(hall.reading("odometry").get<double>("forward"), 0.2, 0.01);
  hall.command("diff_drive", {0.0, 0.0});
  hall.run(2.0);
  EXPECT_EQ(hall.reading("odometry").get<double>("forward"), 0.0);
  EXPECT_EQ(hall.snapshot->counts.awake_bodies, 0U);
}

TEST(DiffDrive, CountsItsWheelsAsTheClosedFormHasIt) {
  Hall hall(
      robot(drive("<odometrySource>encoder</odometrySource>"
                  "<publishWheelJointState>true</publishWheelJointState>")));
  hall.run(0.5);
  hall.command("diff_drive", {0.0, 1.0});
  hall.run(3.0);
  hall.command("diff_drive", {0.0, 0.0});
  hall.run(2.0);
  const std::vector<double> angles = list(hall.reading("wheel_states"), "positions");
  EXPECT_NEAR(angles[1], 3.0 * 0.15 / 0.05, 0.05);
  EXPECT_NEAR(angles[0], -angles[1], 0.05);
  const Reading odometry = hall.reading("odometry");
  const std::vector<double> q = list(odometry, "orientation");
  const double yaw = 2.0 * std::atan2(q[2], q[3]);
  EXPECT_NEAR(std::remainder(yaw - (angles[1] - angles[0]) * 0.05 / 0.3, 2 * M_PI), 0.0, 1e-3);
  EXPECT_NEAR(std::remainder(yaw - to_rpy(hall.pose().rotation).z(), 2 * M_PI), 0.0, 0.1);
}

TEST(DiffDrive, SaysWhichJointIsMissing) {
  try {
    Hall hall(robot(plugin("diff_drive", "<rightJoint>missing</rightJoint>")));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("model 'bot' has no joint 'missing'; known are"),
              std::string::npos);
  }
}

TEST(DiffDrive, IsNotAdoptedByTheWorldsOwnDrive) {
  const std::string own =
      "<plugin name='o' filename='librobot_controller.so'><leftJoint>left_joint</leftJoint>"
      "<rightJoint>right_joint</rightJoint></plugin>";
  const Hall driven(robot(drive()) + own);
  EXPECT_EQ(driven.snapshot->structure->devices.size(), 1U);
  const Hall unknown(
      robot("<plugin name='x' filename='libtheirs.so'><l>left_joint</l></plugin>") + own, true);
  EXPECT_TRUE(unknown.snapshot->structure->devices.empty());
  EXPECT_TRUE(unknown.warns("libtheirs.so is not found"));
  const Hall adopted(robot("") + own);
  ASSERT_EQ(adopted.snapshot->structure->devices.size(), 1U);
  EXPECT_TRUE(adopted.warns("are 0.3 m apart"));
}

TEST(DiffDrive, AWheelThatNothingDrivesIsToldOf) {
  const Hall hall("<model name='bot'><link name='body'/>" + wheel("left_wheel", 0, 0.1) +
                  wheel("right_wheel", 0, -0.1) + "</model>");
  EXPECT_TRUE(hall.warns("no plug-in drives joint 'left_wheel_joint' of model 'bot'; for drive"));
}

TEST(DiffDrive, AnUnknownParameterIsAnErrorOrAWarning) {
  const std::string text = robot(drive("<colour>red</colour>"));
  EXPECT_THROW(Hall{text}, Error);
  const Hall hall(text, true);
  EXPECT_TRUE(hall.warns("<colour> is not a parameter of libgazebo_ros_diff_drive.so"));
  EXPECT_EQ(hall.snapshot->structure->devices.size(), 1U);
}

TEST(DiffDrive, OfAParameterThatIsGivenTwiceTheFirstHoldsInGazebosModels) {
  const std::string text = robot(drive("<updateRate>20</updateRate>"));
  EXPECT_THROW(Hall{text}, Error);
  Hall hall(text, true);
  EXPECT_TRUE(hall.warns("<updateRate> is given twice; the first one is used"));
  hall.run(0.1);
  EXPECT_EQ(hall.reading("odometry").stamp % (kSecond / 50), 0);
  EXPECT_EQ(hall.snapshot->structure->sensors[hall.sensor("odometry")].schedule.publish,
            kSecond / 50);
}

TEST(DiffDrive, WarningsOfARejectedSpawnAreNotTheNextOnes) {
  Hall hall(robot(drive()), true);
  const std::string text = "<sdf version='1.6'>" + robot(drive("<colour>red</colour>")) + "</sdf>";
  load::SearchPaths paths;
  paths.default_dialect = load::DefaultDialect::kAuto;
  auto rejected = hall.simulation.post(sim::Spawn{load::model(text, "bot", {}, paths, true)});
  hall.run(0.001);
  EXPECT_FALSE(rejected.get().ok);
  auto taken = hall.simulation.post(
      sim::Spawn{load::model("<model name='box'><link name='l'/></model>", "", {}, paths)});
  hall.run(0.001);
  EXPECT_EQ(taken.get().message, "spawned box");
  for (const sim::Event& event : hall.snapshot->events) EXPECT_NE(event.event, "warning");
  auto second = hall.simulation.post(
      sim::Spawn{load::model(text, "bot2", {{3, 0, 0}, Quat::Identity()}, paths, true)});
  hall.run(0.001);
  EXPECT_NE(second.get().message.find("<colour> is not a parameter"), std::string::npos);
}

}  // namespace
}  // namespace angen::robots
