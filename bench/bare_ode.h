#pragma once

#include <ode/ode.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "desc/world.h"

/// A described world in bare ODE with the fastest of its spaces: a quadtree per storey for static
/// geometry, sweep and prune for movers; auto-disable, dWorldStep, a PD torque for each joint
/// that has stops and a motor for each that has none. No devices, no sensors, no poses handed out.
namespace angen::bench {

class BareOde {
 public:
  explicit BareOde(const desc::World& world) {
    dInitODE2(0);
    world_ = dWorldCreate();
    moving_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, world.gravity.x(), world.gravity.y(), world.gravity.z());
    dWorldSetCFM(world_, 1e-9);
    dWorldSetAutoDisableFlag(world_, 1);
    dWorldSetAutoDisableSteps(world_, 500);
    for (const desc::Model& model : world.models) add(model);
  }
  ~BareOde() {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(moving_);
    for (const auto& [floor, space] : static_) dSpaceDestroy(space);
    dWorldDestroy(world_);
  }
  BareOde(const BareOde&) = delete;
  BareOde& operator=(const BareOde&) = delete;

  void step(double time, double h) {
    for (const Driven& joint : driven_) push(joint, time);
    dSpaceCollide(moving_, this, &touch);
    for (const dBodyID body : bodies_) {
      if (!dBodyIsEnabled(body)) continue;
      for (dGeomID geom = dBodyGetFirstGeom(body); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
        for (const auto& [floor, space] : static_) {
          dSpaceCollide2(geom, reinterpret_cast<dGeomID>(space), this, &touch);
        }
      }
    }
    dWorldStep(world_, h);
    dJointGroupEmpty(contacts_);
  }

  int awake() const {
    int count = 0;
    for (const dBodyID body : bodies_) count += dBodyIsEnabled(body);
    return count;
  }

 private:
  struct Driven {
    dJointID joint;
    bool slides;
    double lower;
    double upper;
    double stiffness;  // N/m or N m/rad
    double damping;
    double weight;  // N that it carries
  };

  static void touch(void* self, dGeomID a, dGeomID b) {
    const auto& bare = *static_cast<BareOde*>(self);
    if (dGeomIsSpace(a) || dGeomIsSpace(b)) return dSpaceCollide2(a, b, self, &touch);
    const dBodyID one = dGeomGetBody(a);
    const dBodyID two = dGeomGetBody(b);
    const auto rests = [](dBodyID body) { return body == nullptr || !dBodyIsEnabled(body); };
    // Collisions of one model are not tested against each other.
    if ((rests(one) && rests(two)) || dGeomGetData(a) == dGeomGetData(b)) return;
    dContact found[8];
    const int n = dCollide(a, b, 8, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < n; ++i) {
      found[i].surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM;
      found[i].surface.mu = 1.0;
      found[i].surface.soft_erp = 0.2;
      found[i].surface.soft_cfm = 1e-8;
      dJointAttach(dJointCreateContact(bare.world_, bare.contacts_, &found[i]), one, two);
    }
  }

  static void push(const Driven& d, double time) {
    if (d.upper - d.lower > 100.0) return;  // a wheel has its motor
    const double middle = 0.5 * (d.lower + d.upper), reach = 0.45 * (d.upper - d.lower);
    const double target = middle + reach * std::sin(time);
    if (d.slides) {
      const double error = target - dJointGetSliderPosition(d.joint);
      dJointAddSliderForce(d.joint, d.weight + d.stiffness * error -
                                        d.damping * dJointGetSliderPositionRate(d.joint));
    } else {
      const double error = target - dJointGetHingeAngle(d.joint);
      dJointAddHingeTorque(d.joint,
                           d.stiffness * error - d.damping * dJointGetHingeAngleRate(d.joint));
    }
  }

  // Links that fixed joints connect are one body, that of the first; "world" and static links have
  // none.
  void add(const desc::Model& model) {
    std::map<std::string, std::string> part_of;
    for (const desc::Link& link : model.links) {
      part_of[link.name] = model.is_static || link.kinematic ? "world" : link.name;
    }
    part_of["world"] = "world";
    for (const desc::Joint& joint : model.joints) {
      if (joint.type != desc::Joint::Type::kFixed) continue;
      const std::string from = part_of[joint.child], to = part_of[joint.parent];
      for (auto& [link, part] : part_of) {
        if (part == from || part == to) part = from == "world" ? from : to;
      }
    }
    std::map<std::string, dBodyID> bodies{{"world", nullptr}};
    for (const desc::Link& link : model.links) {
      if (part_of[link.name] == link.name) bodies[link.name] = make_body(model, link);
    }
    for (const desc::Link& link : model.links) add_shapes(model, link, bodies[part_of[link.name]]);
    for (const desc::Joint& joint : model.joints) {
      if (joint.type == desc::Joint::Type::kFixed) continue;
      add_joint(model, joint, bodies[part_of[joint.child]], bodies[part_of[joint.parent]]);
    }
  }

  dBodyID make_body(const desc::Model& model, const desc::Link& link) {
    const dBodyID body = dBodyCreate(world_);
    const Pose at = model.pose * link.pose * link.inertial.pose;
    dMass mass;
    dMassSetZero(&mass);
    mass.mass = link.inertial.mass;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) mass.I[4 * i + k] = link.inertial.moment(i, k);
    }
    dBodySetMass(body, &mass);
    const dQuaternion q{at.rotation.w(), at.rotation.x(), at.rotation.y(), at.rotation.z()};
    dBodySetPosition(body, at.position.x(), at.position.y(), at.position.z());
    dBodySetQuaternion(body, q);
    dBodySetGravityMode(body, link.gravity ? 1 : 0);
    bodies_.push_back(body);
    return body;
  }

  static dGeomID make_shape(const Shape& shape) {
    switch (shape.type) {
      case Shape::Type::kBox:
        return dCreateBox(nullptr, shape.size.x(), shape.size.y(), shape.size.z());
      case Shape::Type::kSphere:
        return dCreateSphere(nullptr, shape.radius);
      case Shape::Type::kCylinder:
        return dCreateCylinder(nullptr, shape.radius, shape.length);
      case Shape::Type::kCapsule:
        return dCreateCapsule(nullptr, shape.radius, shape.length);
      case Shape::Type::kPlane:
        return dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
      default:
        return nullptr;
    }
  }

  void add_shapes(const desc::Model& model, const desc::Link& link, dBodyID body) {
    for (const desc::Collision& collision : link.collisions) {
      const dGeomID geom = make_shape(collision.shape);
      if (geom == nullptr) continue;
      dGeomSetData(geom, const_cast<desc::Model*>(&model));
      const Pose at = model.pose * link.pose * collision.pose;
      const dQuaternion q{at.rotation.w(), at.rotation.x(), at.rotation.y(), at.rotation.z()};
      if (body != nullptr) {
        dGeomSetBody(geom, body);
        dGeomSetOffsetWorldPosition(geom, at.position.x(), at.position.y(), at.position.z());
        dGeomSetOffsetWorldQuaternion(geom, q);
        dSpaceAdd(moving_, geom);
        continue;
      }
      dSpaceID& space = static_[static_cast<int>(std::floor((at.position.z() + 0.5) / 4.0))];
      if (space == nullptr) {
        const dVector3 center{0.0, 0.0, at.position.z()}, reach{20.0, 20.0, 4.0};
        space = dQuadTreeSpaceCreate(nullptr, center, reach, 4);
      }
      dSpaceAdd(space, geom);
      if (collision.shape.type == Shape::Type::kPlane) continue;
      dGeomSetPosition(geom, at.position.x(), at.position.y(), at.position.z());
      dGeomSetQuaternion(geom, q);
    }
  }

  void add_joint(const desc::Model& model, const desc::Joint& from, dBodyID child, dBodyID parent) {
    using Type = desc::Joint::Type;
    const Vec3 anchor = model.pose * from.anchor;
    if (from.type == Type::kBall) {
      const dJointID ball = dJointCreateBall(world_, nullptr);
      dJointAttach(ball, child, parent);
      dJointSetBallAnchor(ball, anchor.x(), anchor.y(), anchor.z());
      return;
    }
    const desc::JointAxis& axis = from.axes.at(0);
    const Vec3 along = model.pose.rotation * axis.xyz;
    Driven driven{nullptr, from.type == Type::kPrismatic, axis.lower, axis.upper, 0.0, 0.0, 0.0};
    dMass mass;
    dBodyGetMass(child, &mass);
    const double inertia = driven.slides ? mass.mass : mass.mass / 3.0;
    driven.stiffness = 100.0 * inertia;  // a swing takes 0.6 s and is damped as much as may be
    driven.damping = 20.0 * inertia;
    if (driven.slides) {
      driven.weight = 9.81 * mass.mass * along.z();
      driven.joint = dJointCreateSlider(world_, nullptr);
      dJointAttach(driven.joint, child, parent);
      dJointSetSliderAxis(driven.joint, along.x(), along.y(), along.z());
    } else {
      driven.joint = dJointCreateHinge(world_, nullptr);
      dJointAttach(driven.joint, child, parent);
      dJointSetHingeAnchor(driven.joint, anchor.x(), anchor.y(), anchor.z());
      dJointSetHingeAxis(driven.joint, along.x(), along.y(), along.z());
      if (axis.upper - axis.lower > 100.0) {
        dJointSetHingeParam(driven.joint, dParamVel, 3.0);
        dJointSetHingeParam(driven.joint, dParamFMax, 1.0);
      }
    }
    driven_.push_back(driven);
  }

  dWorldID world_ = nullptr;
  dSpaceID moving_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::map<int, dSpaceID> static_;  // by storey
  std::vector<dBodyID> bodies_;
  std::vector<Driven> driven_;
};

}  // namespace angen::bench
