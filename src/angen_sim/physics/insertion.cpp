#include "physics/drive.h"
#include "physics/joints.h"
#include "physics/sleep.h"

namespace angen::physics {

namespace {

// Inertia about x and y that keeps any contact from tilting an upright link (kg m^2).
constexpr double kUprightMoment = 1e8;

void set_mass(const Body& body) {
  Eigen::Matrix3d moment = body.moment;
  if (body.upright) {
    const Vec3 up = body.upright_at.conjugate() * Vec3::UnitZ();
    const double about_up = up.dot(moment * up);
    moment = kUprightMoment * (Eigen::Matrix3d::Identity() - up * up.transpose()) +
             about_up * up * up.transpose();
  }
  dMass mass;
  dMassSetZero(&mass);
  mass.mass = body.mass;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) mass.I[4 * row + column] = moment(row, column);
  }
  dBodySetMass(body.ode.get(), &mass);
}

void create_body(dWorldID world, Body& body) {
  body.ode.reset(dBodyCreate(world));
  dBodySetFiniteRotationMode(body.ode.get(), 1);
  dBodySetGravityMode(body.ode.get(), body.floats ? 0 : 1);
  set_mass(body);
}

}  // namespace

// Joints are attached at position 0, and only then are the bodies moved to their poses:
// rounding errors do not add up however often this is done.
void insert(dWorldID world, Mechanism& mechanism) {
  const Pose& model = mechanism.bodies.front()->model->pose;
  for (Body* body : mechanism.bodies) {
    create_body(world, *body);
    ode::set_pose(body->ode.get(), model * body->zero);
  }
  for (Joint* joint : mechanism.joints) {
    create_joint(world, *joint);
    anchor_joint(*joint, model);
  }
  for (Body* body : mechanism.bodies) {
    ode::set_pose(body->ode.get(), body->at);
    if (body->drive) make_drive(world, *body);
  }
}

void take_out(Mechanism& mechanism) {
  for (Joint* joint : mechanism.joints) {
    joint->main.reset();
    joint->motor.reset();
    joint->thread.reset();
  }
  for (Body* body : mechanism.bodies) {
    if (body->drive) {
      body->drive->linear.reset();
      body->drive->angular.reset();
    }
    body->ode.reset();
  }
}

}  // namespace angen::physics
