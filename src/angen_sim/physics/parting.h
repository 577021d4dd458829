#pragma once

#include <functional>
#include <vector>

#include "physics/contacts.h"
#include "physics/solver.h"

namespace angen::physics {

/// Finds the bodies that overlap, and all of their islands (`Body::parts`), also for some steps
/// after the overlap, until joints are straight again. Such bodies part without getting speed by
/// it: a step is taken twice, with the push of contacts, stops and joints that corrects positions
/// and without. The velocities are those without, in the axes of bodies; the poses also follow the
/// difference, by which no mechanism moves faster than deep contacts separate. Otherwise the
/// pushes of several contacts would add up, and small ones that face each other almost throw a
/// wedge. Returns whether there are any.
bool mark_parting(const std::vector<Body*>& awake, const Contacts& contacts);

/// The second of the two steps, of bodies that were at `start` (as `awake`) before the first one.
/// `solve` takes a step of those bodies from there, without the push of contacts.
void part(const std::vector<Body*>& awake, const std::vector<BodyState>& start, double fastest,
          double h, const std::function<void()>& solve);

}  // namespace angen::physics
