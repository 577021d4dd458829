#include "physics/drive.h"

#include <cmath>

namespace angen::physics {

namespace {

// Shares of the force along and across the desired force, and along each axis if that is less
// than kEasy: their squares add up to just under 1.
constexpr double kAlong = 0.99;
constexpr double kAcross = 0.14;
constexpr double kEither = 0.707;
constexpr double kEasy = 0.5;  // share of the greatest force
constexpr double kArm = 0.25;  // m; the turning torque is the force on this arm

}  // namespace

void make_drive(dWorldID world, Body& body) {
  Drive& drive = *body.drive;
  drive.linear.reset(dJointCreateLMotor(world, nullptr));
  dJointAttach(drive.linear.get(), body.ode.get(), nullptr);
  dJointSetLMotorNumAxes(drive.linear.get(), 2);
  drive.feedback = {};
  dJointSetFeedback(drive.linear.get(), &drive.feedback);
  drive.angular.reset(dJointCreateAMotor(world, nullptr));
  dJointAttach(drive.angular.get(), body.ode.get(), nullptr);
  dJointSetAMotorNumAxes(drive.angular.get(), 1);
  dJointSetAMotorAxis(drive.angular.get(), 0, 0, 0.0, 0.0, 1.0);
}

bool is_driven(const Body& body) {
  return body.drive && body.drive->max_force > 0.0 &&
         (!body.drive->velocity.isZero() || body.drive->yaw_rate != 0.0);
}

bool set_drive(dWorldID world, Body& body, const Vec3& velocity, double yaw_rate,
               double max_force) {
  const Vec3 flat(velocity.x(), velocity.y(), 0.0);
  if (max_force <= 0.0) {
    const bool had = body.drive.has_value();
    body.drive.reset();
    return had;
  }
  const bool had = body.drive.has_value();
  if (!had) body.drive.emplace();
  Drive& drive = *body.drive;
  if (had && drive.velocity == flat && drive.yaw_rate == yaw_rate && drive.max_force == max_force) {
    return false;
  }
  drive.velocity = flat;
  drive.yaw_rate = yaw_rate;
  drive.max_force = max_force;
  if (body.ode == nullptr) return true;
  if (drive.linear == nullptr) make_drive(world, body);
  return true;
}

// The desired force is the one that held the load in the last step, plus the one that brings the
// speed to its goal in this step.
void aim_drive(const Body& body, double h) {
  const Drive& drive = *body.drive;
  const Vec3 target =
      ode::vec(drive.feedback.f1) + body.mechanism->mass / h * (drive.velocity - body.velocity());
  const Vec3 flat(target.x(), target.y(), 0.0);
  const bool easy = flat.norm() < kEasy * drive.max_force;
  const Vec3 along = easy ? Vec3::UnitX() : flat.normalized();
  const Vec3 across = Vec3::UnitZ().cross(along);
  dJointID linear = drive.linear.get();
  dJointSetLMotorAxis(linear, 0, 0, along.x(), along.y(), 0.0);
  dJointSetLMotorAxis(linear, 1, 0, across.x(), across.y(), 0.0);
  dJointSetLMotorParam(linear, dParamVel1, along.dot(drive.velocity));
  dJointSetLMotorParam(linear, dParamVel2, across.dot(drive.velocity));
  dJointSetLMotorParam(linear, dParamFMax1, (easy ? kEither : kAlong) * drive.max_force);
  dJointSetLMotorParam(linear, dParamFMax2, (easy ? kEither : kAcross) * drive.max_force);
  dJointSetAMotorParam(drive.angular.get(), dParamVel1, drive.yaw_rate);
  dJointSetAMotorParam(drive.angular.get(), dParamFMax1, kArm * drive.max_force);
}

void set_upright(Body& body) {
  dBodyID ode = body.ode.get();
  const Quat turned = ode::quat(dBodyGetQuaternion(ode)) * body.upright_at.conjugate();
  const double half_yaw = std::atan2(turned.z(), turned.w());
  const Quat q = Quat(std::cos(half_yaw), 0.0, 0.0, std::sin(half_yaw)) * body.upright_at;
  const dQuaternion straight{q.w(), q.x(), q.y(), q.z()};
  dBodySetQuaternion(ode, straight);
  dBodySetAngularVel(ode, 0.0, 0.0, body.spin().z());
}

}  // namespace angen::physics
