#pragma once

#include <cstddef>

#include "physics/model.h"

namespace angen::physics {

/// The part of one contact point in load and friction.
struct PointShare {
  double stiffness = 1.0;  // share of a point's
  double least_cfm = 0.0;  // m/s per N
  double friction = 1.0;   // share of a point's
  double spring = 1.0;     // share of a point's spring, see Mechanism
  double depth = 0.0;      // m, where that spring is slack: of the middle of a line, for its ends
};

/// Marks cylinders that turn about their own axis, by a joint of their body: wheels.
void mark_wheels(const ModelRecord& record);

/// A wheel touches a surface along a line, of which ODE finds the ends. Two ends with friction
/// would slip against each other in each turn, so the line gets a point in its middle that has all
/// the friction and nearly all the load, as a disc has, and its ends only keep it from tilting.
/// Writes a share for each of n points and of those that it adds, and returns their number.
std::size_t add_middles(const Geom& first, const Geom& second, dContactGeom* points, std::size_t n,
                        PointShare* shares);

}  // namespace angen::physics
