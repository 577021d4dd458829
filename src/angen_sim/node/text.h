#pragma once

#include <string>
#include <vector>

#include "sim/command.h"

/// The texts of command topics. `ros` is taken by roscpp, hence `node`.
namespace angen::node {

/// Texts of at most 4096 bytes. Each returns what to post: a ToDevice, whose verb and numbers the
/// queue parses, or a Reject that says why and lists the right forms.
/// `VERB, NAME|all[, NUMBER]`, as the kind's command topic takes it; a kind with a verb such as
/// `Floor1` needs no name.
sim::Action topic_action(const Kind& kind, const std::string& text);
/// /angen/command: NAME or KIND/NAME.
sim::Action any_action(const std::string& target, const std::string& text);
/// The parameter ~commands, "TARGET TEXT; TARGET TEXT": each as any_action(), in order.
std::vector<sim::Action> listed_actions(const std::string& list);

}  // namespace angen::node
