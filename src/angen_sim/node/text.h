#pragma once

#include <string>
#include <vector>

#include "sim/command.h"

/// The texts of command topics. `ros` is taken by roscpp, hence `node`.
namespace angen::node {

/// Texts of at most 4096 bytes. Each returns what to post: a ToDevice, or a Reject that says why
/// and lists the right forms. `VERB, NAME|all[, NUMBER]`, as the kind's command topic takes it;
/// `names` are the kind's devices: where there is one alone, a verb with an integer (`Floor1`)
/// needs no name.
sim::Action topic_action(const Kind& kind, const std::string& text,
                         const std::vector<std::string>& names);
/// /angen/command: NAME or KIND/NAME; a text of numbers alone becomes the command's values.
sim::Action any_action(const std::string& target, const std::string& text);

}  // namespace angen::node
