#include "plugin/command.h"

#include <cmath>

#include "core/text.h"
#include "fuzz/targets.h"
#include "node/text.h"
#include "plugin/library.h"

namespace angen::fuzz {
namespace {

// The kinds of devices of all of Angen's own plug-ins.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = [] {
    std::vector<Kind> found;
    Catalog catalog;
    for (const auto& plugin : catalog.own()) {
      if (!plugin->makes_sensors()) found.push_back(plugin->kind());
    }
    require(!found.empty(), "there are plug-ins");
    return found;
  }();
  return all;
}

void check(const sim::Action& action) {
  if (const auto* reject = std::get_if<sim::Reject>(&action)) {
    require(valid_utf8(reject->reason), "a reason is UTF-8");
    return;
  }
  const auto& to = std::get<sim::ToDevice>(action);
  require(std::isfinite(to.command.number), "a command's number is finite");
  for (const double value : to.command.values) require(std::isfinite(value), "values are finite");
}

}  // namespace

void command(const std::string& input) {
  const Split given = split(input);
  const Kind& kind = kinds()[given.choice % kinds().size()];
  check(node::topic_action(kind, given.rest));
  const std::size_t comma = given.rest.find(',');
  const std::string target = given.rest.substr(0, comma);
  const std::string text = comma == std::string::npos ? "" : given.rest.substr(comma + 1);
  sim::Action action = node::any_action(target, text);
  check(action);
  auto* to = std::get_if<sim::ToDevice>(&action);
  if (to == nullptr || !parse_command(kind, to->command).empty()) return;
  for (const Verb& verb : kind.verbs) {
    if (verb.name != to->command.verb || verb.argument.empty()) continue;
    require(verb.range.contains(to->command.number), "the number is in the verb's range");
  }
}

}  // namespace angen::fuzz
