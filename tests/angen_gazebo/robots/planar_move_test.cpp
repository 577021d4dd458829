#include <gtest/gtest.h>

#include "robot.h"

namespace angen::robots {
namespace {

// The names that others gave the same drive, and their word for the timeout.
TEST(PlanarMove, ForceBasedMoveIsTheSame) {
  for (const char* library : {"gazebo_ros_force_based_move", "hector_gazebo_ros_force_based_move",
                              "ridgeback_ros_force_based_move", "robotnik_force_based_move",
                              "nexus_ros_force_based_move"}) {
    Hall hall(
        "<model name='bot'>" + box("body", 5.0, "0 0 0.1 0 0 0", "0.4 0.4 0.2") +
            "<plugin name='p' filename='lib" + library +
            ".so'><cmdVelTimeOut>0.5</cmdVelTimeOut><x_velocity_p_gain>10000</x_velocity_p_gain>"
            "<publishOdometryTf>0</publishOdometryTf></plugin></model>",
        true);
    EXPECT_TRUE(hall.warnings.empty()) << library;
    hall.run(0.2);
    hall.command("planar_move", {0.2, 0.1, 0.0});
    hall.run(2.0);
    EXPECT_NEAR(hall.pose().position.x(), 0.1, 0.01) << library;
    EXPECT_NEAR(hall.pose().position.y(), 0.05, 0.01) << library;
  }
}

// As the fork of the Nexus 4WD has it.
TEST(PlanarMove, ACommandIsLimited) {
  Hall hall("<model name='bot'>" + box("body", 5.0, "0 0 0.1 0 0 0", "0.4 0.4 0.2") +
                "<plugin name='p' filename='libnexus_ros_force_based_move.so'>"
                "<max_x_velocity>0.3</max_x_velocity><max_yaw_velocity>0.5</max_yaw_velocity>"
                "</plugin></model>",
            true);
  EXPECT_TRUE(hall.warnings.empty());
  hall.run(0.2);
  hall.command("planar_move", {-1.0, 0.4, 0.0});
  hall.run(1.0);
  EXPECT_NEAR(hall.pose().position.x(), -0.3, 0.01);
  EXPECT_NEAR(hall.pose().position.y(), 0.4, 0.01);
  hall.command("planar_move", {0.0, 0.0, 2.0});
  hall.run(1.0);
  EXPECT_NEAR(to_rpy(hall.pose().rotation).z(), 0.5, 0.01);
}

}  // namespace
}  // namespace angen::robots
