// libgazebo_ros_skid_steer_drive.so
#include "plugin/registration.h"
#include "robots/wheels.h"

namespace angen::robots {

namespace {

WheelSettings read_skid(Params& params) {
  read_topics(params);
  WheelSettings s;
  s.separation = params.number("wheelSeparation", 0.4, "m", "between left and right", kPositive);
  s.radius = params.number("wheelDiameter", 0.15, "m", "diameter of a wheel", kPositive) / 2.0;
  s.torque = params.number("torque", 5.0, "N m", "greatest torque of a wheel", kPositive);
  const auto joint = [&](const char* path, const char* fallback) {
    return params.text(path, fallback, "joint of that wheel");
  };
  s.left = {joint("leftFrontJoint", "left_front_joint"), joint("leftRearJoint", "left_rear_joint")};
  s.right = {joint("rightFrontJoint", "right_front_joint"),
             joint("rightRearJoint", "right_rear_joint")};
  params.flag("broadcastTF", true, "the transform from odometry to base is published");
  for (const char* path : {"covariance_x", "covariance_y", "covariance_yaw"}) {
    params.number(path, 1e-4, "", "not used: the odometry is the truth", kNotNegative);
  }
  return s;
}

Kind skid_kind() {
  return wheels_kind("skid_steer_drive",
                     "Two driven wheels on each side, which slip when it turns.");
}

}  // namespace

class SkidSteerOdometry : public TrueOdometry<WheelSettings, read_skid> {
 public:
  static Kind describe() {
    return odometry_kind("skid_steer_odometry", "Odometry of a skid-steered robot.", 100.0);
  }
};

using SkidSteerPlugin = WheelsPlugin<read_skid, skid_kind>;

}  // namespace angen::robots

ANGEN_REGISTER_PLUGIN(angen::robots::SkidSteerPlugin)
ANGEN_REGISTER_PLUGIN(angen::robots::ModelSensorPlugin<angen::robots::SkidSteerOdometry>)
