#pragma once

#include <memory>
#include <mutex>
#include <sdf/sdf.hh>
#include <string>

#include "core/pose.h"
#include "load/expand.h"

/// The only place that calls libsdformat: types, the schema, frames and poses.
namespace angen::load {

/// While one lives, nothing that libsdformat or urdfdom say reaches the console; it is kept
/// instead. Their streams are global: one holder at a time, others wait.
class Hush {
 public:
  Hush();
  ~Hush();
  Hush(const Hush&) = delete;
  Hush& operator=(const Hush&) = delete;

  std::string messages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Gives back to the system, at its end, what libsdformat needed: a megabyte a link.
struct Memory {
  Memory() = default;
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
};

/// A <world> element of SDF 1.9 that has passed the checks, as libsdformat sees it. Its first error
/// is thrown as Error at the place the element came from; unknown elements are warnings.
sdf::Root parse_world(const Element& world, Session& session);

/// The pose of something seen from `frame` ("" = what it stands in). Throws Error at `at`.
Pose resolve(const sdf::SemanticPose& pose, const std::string& frame, const Source& at);

Pose to_pose(const ignition::math::Pose3d& pose);
Vec3 to_vec(const ignition::math::Vector3d& v);

}  // namespace angen::load
