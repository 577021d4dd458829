#pragma once

#include "physics/model.h"

namespace angen::physics {

/// Inserts a mechanism's bodies into ODE at their poses and at rest, with joints and motors. A
/// step of ODE visits all bodies that it has, so it has only those that are awake.
void insert(dWorldID world, Mechanism& mechanism);

/// Takes a mechanism out of ODE again; its bodies stay where they are, at rest.
void take_out(Mechanism& mechanism);

}  // namespace angen::physics
