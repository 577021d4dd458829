#pragma once

#include <string>
#include <vector>

#include "sim/command.h"

/// The texts of command topics. `ros` is taken by roscpp, hence `node`.
namespace angen::node {

/// Each returns what to post: a ToDevice, or a Reject that says why and lists the right forms.
/// `Open, NAME|all`, `Close, NAME|all`, `Set, NAME|all, RADIANS`; windows and cabinets take the
/// same. `source` is the controller that a Reject names.
sim::Action door_action(const std::string& text, const std::string& kind = "door",
                        const std::string& source = "Door_controller");
/// `On, NAME|all`, `Off, NAME|all`, `Dim, NAME|all, PERCENT`
sim::Action lamp_action(const std::string& text);
/// `Floor<N>`, `Floor<N>, NAME`; `elevators` are the ones that exist, for the form without a name.
sim::Action elevator_action(const std::string& text, const std::vector<std::string>& elevators);
/// /angen/command: NAME or KIND/NAME; a text of numbers alone becomes the command's values.
sim::Action any_action(const std::string& target, const std::string& text);

}  // namespace angen::node
