#include "node/text.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/diagnostics.h"
#include "core/text.h"
#include "core/typography.h"

namespace angen::node {
namespace {

constexpr std::size_t kLongest = 4096;  // bytes of a command

std::string too_long(std::size_t bytes) {
  return std::to_string(bytes) + " bytes, at most " + std::to_string(kLongest) + " are read";
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

sim::Action topic_action(const Kind& kind, const std::string& text,
                         const std::vector<std::string>& names) {
  const std::string source = kind.command_topic.substr(kind.command_topic.rfind('/') + 1);
  const auto wrong = [&](const std::string& why) {
    return reject(source, kind.name, text, why,
                  "right is VERB, NAME[, NUMBER]; verbs are " + forms_of(kind));
  };
  if (text.size() > kLongest) return wrong(too_long(text.size()));
  if (!valid_utf8(text)) return wrong("not UTF-8");
  const std::vector<std::string> fields = fields_of(unquoted(text));
  if (fields[0].empty()) return wrong("no verb");
  std::size_t most = 1;
  for (const Verb& verb : kind.verbs) most = std::max(most, verb.count);
  if (fields.size() > 2 + most) return wrong("too many parts");
  std::string name = fields.size() > 1 ? fields[1] : "";
  if (fields.size() > 1 && name.empty()) return wrong("no name");
  Command command{fields[0], {}, "", 0.0};
  for (std::size_t i = 2; i < fields.size(); ++i) command.text += " " + fields[i];
  const std::string reason = parse_command(kind, command);
  if (!reason.empty()) return wrong(printable(reason, 400));
  // The only elevator needs no name: `Floor1`.
  const bool counted = std::any_of(kind.verbs.begin(), kind.verbs.end(), [&](const Verb& verb) {
    return verb.whole && verb.name == command.verb;
  });
  if (name.empty() && counted && names.size() == 1) name = names.front();
  if (name.empty()) return wrong(names.empty() ? "there is no " + kind.name : "no name");
  return sim::ToDevice{kind.name, name, std::move(command)};
}

sim::Action any_action(const std::string& target, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return reject("command", "command", target + ": " + text, why,
                  "right is a device's name (or KIND/NAME) as target and its verb as text");
  };
  const std::size_t bytes = target.size() + text.size();
  if (bytes > kLongest) return wrong(too_long(bytes));
  if (!valid_utf8(target) || !valid_utf8(text)) return wrong("not UTF-8");
  const std::string name = unquoted(target);
  if (name.empty()) return wrong("no target");
  Command command{trimmed(text), {}, "", 0.0};
  const std::string plain = unquoted(without_typography(text));
  if (plain.empty()) return wrong("no text");
  std::vector<double> values;
  std::size_t start = 0;
  while (start < plain.size()) {
    const std::size_t end = std::min(plain.find_first_of(" ,", start), plain.size());
    if (end > start) {
      const std::optional<double> value = parse_finite(plain.substr(start, end - start));
      if (!value) {
        values.clear();
        break;
      }
      values.push_back(*value);
    }
    start = end + 1;
  }
  command.values = std::move(values);
  return sim::ToDevice{"", name, std::move(command)};
}

}  // namespace angen::node
