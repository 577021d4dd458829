#pragma once

#include "physics/contacts.h"
#include "physics/model.h"

namespace angen::physics {

/// Inserts a mechanism's bodies into ODE at their poses and at rest, with joints and motors. A
/// step of ODE visits all bodies that it has, so it has only those that are awake.
void insert(dWorldID world, Mechanism& mechanism);

/// Takes a mechanism out of ODE again; its bodies stay where they are, at rest.
void take_out(Mechanism& mechanism);

/// Wakes the mechanism of a dynamic body, whose idle times go on. ODE does not have it yet.
void wake_up(Body& body, std::vector<Body*>& awake);

/// Puts a mechanism to sleep for good at its poses before the step: nothing wakes it.
void stop(Mechanism& mechanism, std::vector<Body*>& awake);

/// Puts whole islands to sleep (bodies that touch or are jointed) when each of their bodies has
/// been slower than 0.01 m/s and 0.01 rad/s and within 0.01 mm and 0.01 mrad for half a second (in
/// piles that are iterated slower alone) and no motor turns. Takes them out of
/// `awake`; returns true when something fell asleep. Must follow each step, of `count` times h
/// seconds.
bool let_sleep(std::vector<Body*>& awake, const Contacts& contacts, double h, int count);

}  // namespace angen::physics
