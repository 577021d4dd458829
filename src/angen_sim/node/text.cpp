#include "node/text.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/diagnostics.h"
#include "core/text.h"
#include "core/typography.h"

namespace angen::node {
namespace {

constexpr std::size_t kMaxBytes = 4096;  // bytes of a command

std::string too_long(std::size_t bytes) {
  return std::to_string(bytes) + " bytes, at most " + std::to_string(kMaxBytes) + " are read";
}

std::vector<std::string> fields_of(const std::string& text) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  while (true) {
    const std::size_t comma = text.find(',', start);
    fields.push_back(unquoted(text.substr(start, comma - start)));
    if (comma == std::string::npos) return fields;
    start = comma + 1;
  }
}

sim::Reject reject(const std::string& source, const std::string& kind, const std::string& text,
                   const std::string& why, const std::string& right) {
  return {source, kind, "`" + printable(text) + "`: " + why + "; " + right};
}

}  // namespace

sim::Action topic_action(const Kind& kind, const std::string& text) {
  const std::string source = kind.command_topic().substr(kind.command_topic().rfind('/') + 1);
  const auto wrong = [&](const std::string& why) {
    return reject(source, kind.name, text, why,
                  "right is VERB, NAME[, NUMBER]; verbs are " + forms_of(kind));
  };
  if (text.size() > kMaxBytes) return wrong(too_long(text.size()));
  if (!valid_utf8(text)) return wrong("not UTF-8");
  const std::vector<std::string> fields = fields_of(unquoted(text));
  if (fields[0].empty()) return wrong("no verb");
  if (fields.size() > 1 && is_verb(kind, fields[1]) && !is_verb(kind, fields[0])) {
    return wrong("did you mean `" + fields[1] + ", " + fields[0] + "`?");
  }
  const bool counts = std::any_of(kind.verbs.begin(), kind.verbs.end(),
                                  [](const Verb& verb) { return verb.whole; });
  const std::string name = fields.size() > 1 ? fields[1] : "";
  if (name.empty() && (fields.size() > 1 || !counts)) return wrong("no name");
  Command command{fields[0]};
  for (std::size_t i = 2; i < fields.size(); ++i) command.text += " " + fields[i];
  return sim::ToDevice{kind.name, name, std::move(command)};
}

sim::Action any_action(const std::string& target, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return reject("command", "command", target + ": " + text, why,
                  "right is a device's name (or KIND/NAME) as target and its verb as text");
  };
  const std::size_t bytes = target.size() + text.size();
  if (bytes > kMaxBytes) return wrong(too_long(bytes));
  if (!valid_utf8(target) || !valid_utf8(text)) return wrong("not UTF-8");
  const std::string name = unquoted(target);
  if (name.empty()) return wrong("no target");
  if (unquoted(straightened(text)).empty()) return wrong("no text");
  return sim::ToDevice{"", name, {trimmed(text)}};
}

std::vector<sim::Action> listed_actions(const std::string& list) {
  std::vector<sim::Action> actions;
  std::istringstream entries(list);
  for (std::string entry; std::getline(entries, entry, ';');) {
    entry = trimmed(entry);
    if (entry.empty()) continue;
    const std::size_t blank = std::min(entry.find(' '), entry.size());
    actions.push_back(any_action(entry.substr(0, blank), entry.substr(blank)));
  }
  return actions;
}

}  // namespace angen::node
