#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <memory>
#include <stdexcept>

#include "core/pose.h"

/// Owners of ODE's objects and conversions to and from its numbers.
namespace angen::physics::ode {

struct Destroy {
  void operator()(dxWorld* world) const { dWorldDestroy(world); }
  void operator()(dxBody* body) const { dBodyDestroy(body); }
  void operator()(dxJoint* joint) const {
    dJointSetFeedback(joint, nullptr);
    dJointDestroy(joint);
  }
  void operator()(dxJointGroup* group) const { dJointGroupDestroy(group); }
  void operator()(dxGeom* geom) const { dGeomDestroy(geom); }
  void operator()(dxTriMeshData* data) const { dGeomTriMeshDataDestroy(data); }
  void operator()(dxThreadingImplementation* threads) const {
    dThreadingFreeImplementation(threads);
  }
};

/// An assertion of ODE that does not hold: thrown instead of ending the process. What it was thrown
/// out of (a step, a collision) is left half done.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using WorldHandle = std::unique_ptr<dxWorld, Destroy>;
using BodyHandle = std::unique_ptr<dxBody, Destroy>;
using JointHandle = std::unique_ptr<dxJoint, Destroy>;
using JointGroupHandle = std::unique_ptr<dxJointGroup, Destroy>;
using GeomHandle = std::unique_ptr<dxGeom, Destroy>;
using ThreadingHandle = std::unique_ptr<dxThreadingImplementation, Destroy>;
using MeshHandle = std::unique_ptr<dxTriMeshData, Destroy>;

/// Starts ODE once a process, takes over its messages, and gives the calling thread the data that
/// colliding needs.
void prepare_thread();

/// True when this thread's ODE reported a failed LCP since the last call.
bool take_lcp_failure();

/// Contact points of two geoms, at most `most`; none if ODE fails, at a degenerate triangle, say.
std::size_t collide(dGeomID a, dGeomID b, std::size_t most, dContactGeom* points);

inline Vec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }
inline Quat quat(const dReal* q) { return {q[0], q[1], q[2], q[3]}; }

inline void set_pose(dBodyID body, const Pose& pose) {
  const dQuaternion q{pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  dBodySetQuaternion(body, q);
}

inline void set_pose(dGeomID geom, const Pose& pose) {
  const dQuaternion q{pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()};
  dGeomSetPosition(geom, pose.position.x(), pose.position.y(), pose.position.z());
  dGeomSetQuaternion(geom, q);
}

}  // namespace angen::physics::ode
