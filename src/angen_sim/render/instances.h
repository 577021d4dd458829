#pragma once

#include <memory>
#include <vector>

#include "render/bodies.h"

namespace angen::render {

/// A patch with its place in the world.
struct Placed {
  Face in_world(Face face) const;
  Hull in_patch(const Hull& hull) const { return hull.seen_from(rotation, position); }

  std::unique_ptr<Patch> patch;
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  bool shines_through = false;
  rays::Embree<RTCGeometry> instance{};  // a mover's
};

/// Bodies that may be in the way of some rays.
struct Among {
  bool fixed = true;
  bool movers = true;

  bool none() const { return !fixed && !movers; }
};

/// The opaque faces in a hull.
struct Obstacles {
  Faces faces;
  Among unknown{false, false};  // have more faces than these, or others than polygons
};

/// All patches: one of the bodies that do not move, and one of each mover. Most rays are far from
/// all movers, and are traced in the fixed patch only.
class Instances {
 public:
  Instances();

  /// Adds a mover; returns its number.
  std::uint32_t add(std::unique_ptr<Patch> patch, const Pose& pose, bool throws_shadows);
  /// Sets the patch of the bodies that do not move, after all movers were added.
  void set_fixed(std::unique_ptr<Patch> patch);
  void place(std::uint32_t number, const Pose& pose);
  void clear();
  void commit();

  const Placed& operator[](std::uint32_t number) const { return placed_[number]; }
  const Patch& fixed() const { return *placed_.back().patch; }
  std::uint32_t fixed_number() const { return static_cast<std::uint32_t>(placed_.size() - 1); }

  /// Finds the first hits of the valid rays that are nearer than those they have.
  void find_hits(const int* valid, const Among& among, RTCIntersectContextFlags flags,
                 RTCRayHit16& rays) const;
  /// Sets tfar of the rays with a hit on an opaque body below 0.
  void find_occluded(const int* wanted, const Among& among, RTCRay16& rays) const;
  /// Whether visit(number) is true for one of the movers in the hull, perhaps some beside it.
  template <class Visit>
  bool any_mover_in(const Hull& hull, const Visit& visit) const {
    return boxes_.any([&](const Boxes4& boxes) { return hull.overlaps(boxes); },
                      [&](std::uint32_t i) { return visit(boxed_[i]); });
  }
  /// False only if no mover that throws shadows is in the box.
  bool has_opaque_mover_in(const Box& box) const;
  /// Finds the first opaque face on the way; one of 0 corners is not a polygon. False without one.
  bool find_face(const Eigen::Vector3f& from, const Eigen::Vector3f& to, Face& face) const;
  /// Finds the opaque faces in the hull, perhaps some beside it.
  void find_in(const Hull& hull, Obstacles& obstacles) const;

 private:
  std::vector<Placed> placed_;        // the fixed one is the last
  std::vector<std::uint32_t> boxed_;  // the movers that are not empty
  BoxTree boxes_;                     // boxes of these
  rays::Embree<RTCScene> seen_;       // movers
  rays::Embree<RTCScene> opaque_;     // movers that throw shadows
};

}  // namespace angen::render
