#pragma once

#include "physics/model.h"

namespace angen::physics {

/// Makes the motor of a body that ODE has, as body.drive says.
void make_drive(dWorldID world, Body& body);

/// Sets a body's motor in the plane; returns false when nothing changed. World::drive says the
/// rest.
bool set_drive(dWorldID world, Body& body, const Vec3& velocity, double yaw_rate, double max_force);

/// Whether its motor moves it.
bool is_driven(const Body& body);

/// Divides the force of a drive between its two axes, before a step of h seconds.
void aim_drive(const Body& body, double h);

/// Takes the tilt that rounding left out of an upright body, after a step.
void set_upright(Body& body);

}  // namespace angen::physics
