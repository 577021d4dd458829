#pragma once

#include <vector>

#include "core/element.h"

/// Elements of a <world> that stand for models: <population> and <road>. Both throw Error.
namespace angen::load {

/// Copies of a population's <model>, called NAME_clone_0, NAME_clone_1, …: on a grid, in a row, or
/// strewn over a box or a cylinder, always in the same places.
std::vector<Element> population_models(const Element& population);

/// A static model of flat boxes from one point of the road to the next; nothing collides with it.
Element road_model(const Element& road);

}  // namespace angen::load
