#pragma once

#include "physics/model.h"

namespace angen::physics {

/// Gives a mechanism's bodies to ODE, where they stand and at rest, with its joints and motors. A
/// step of ODE goes through all the bodies that it has, so it has those that are awake.
void insert(dWorldID world, Mechanism& mechanism);

/// Takes a mechanism out of ODE again; its bodies stay where they are, at rest.
void take_out(Mechanism& mechanism);

}  // namespace angen::physics
