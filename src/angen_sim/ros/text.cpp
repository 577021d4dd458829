#include "ros/text.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "core/diagnostics.h"
#include "core/text.h"

namespace angen::node {
namespace {

constexpr char kDoorForms[] =
    "right are `Open, NAME`, `Close, NAME`, `Set, NAME, RADIANS`; NAME "
    "may be `all`";
constexpr char kLampForms[] =
    "right are `On, NAME`, `Off, NAME`, `Dim, NAME, PERCENT`; NAME may "
    "be `all`";
constexpr char kElevatorForms[] =
    "right are `Floor0`, `Floor1`, … and, with several elevators, "
    "`Floor1, NAME`";

std::vector<std::string> fields_of(const std::string& text) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  while (true) {
    const std::size_t comma = text.find(',', start);
    fields.push_back(trimmed(text.substr(start, comma - start)));
    if (comma == std::string::npos) return fields;
    start = comma + 1;
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

sim::Reject reject(const std::string& source, const std::string& kind, const std::string& text,
                   const std::string& why, const std::string& forms) {
  return {source, kind, "`" + printable(text) + "`: " + why + "; " + forms};
}

struct Verb {
  const char* name;
  const char* number;  // what its number is called, null when it takes none
};

// `VERB, NAME` or `VERB, NAME, NUMBER`.
sim::Action listed_action(const std::string& text, const std::string& kind,
                          const std::string& source, const std::vector<Verb>& verbs,
                          const char* forms) {
  const auto wrong = [&](const std::string& why) { return reject(source, kind, text, why, forms); };
  if (!valid_utf8(text)) return wrong("not UTF-8");
  const std::vector<std::string> fields = fields_of(text);
  if (fields[0].empty()) return wrong("no verb");
  const auto verb = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& candidate) {
    return lower(candidate.name) == lower(fields[0]);
  });
  if (verb == verbs.end()) return wrong("unknown verb `" + printable(fields[0]) + "`");
  if (fields.size() < 2 || fields[1].empty()) return wrong("no name");
  const std::size_t wanted = verb->number != nullptr ? 3 : 2;
  if (fields.size() > wanted) return wrong("too many parts");
  std::string command = verb->name;
  if (verb->number != nullptr) {
    if (fields.size() < wanted) return wrong(std::string("no ") + verb->number);
    if (!parse_finite(fields[2])) {
      return wrong("`" + printable(fields[2]) + "` is not a number of " + verb->number);
    }
    command += " " + fields[2];
  }
  return sim::ToDevice{kind, fields[1], {command, {}}};
}

}  // namespace

sim::Action door_action(const std::string& text, const std::string& kind,
                        const std::string& source) {
  return listed_action(text, kind, source,
                       {{"Open", nullptr}, {"Close", nullptr}, {"Set", "radians"}}, kDoorForms);
}

sim::Action lamp_action(const std::string& text) {
  return listed_action(text, "lamp", "Light_controller",
                       {{"On", nullptr}, {"Off", nullptr}, {"Dim", "percent"}}, kLampForms);
}

sim::Action elevator_action(const std::string& text, const std::vector<std::string>& elevators) {
  const auto wrong = [&](const std::string& why) {
    return reject("Elevator_controller", "elevator", text, why, kElevatorForms);
  };
  if (!valid_utf8(text)) return wrong("not UTF-8");
  const std::vector<std::string> fields = fields_of(text);
  if (fields[0].empty()) return wrong("no verb");
  if (lower(fields[0].substr(0, 5)) != "floor") {
    return wrong("unknown verb `" + printable(fields[0]) + "`");
  }
  const std::string floor = trimmed(fields[0].substr(5));
  const bool digits = !floor.empty() && floor.size() <= 4 &&
                      floor.find_first_not_of("0123456789") == std::string::npos;
  if (!digits) return wrong("`" + printable(floor) + "` is not the number of a floor");
  if (fields.size() > 2) return wrong("too many parts");
  std::string name = fields.size() == 2 ? fields[1] : "";
  if (fields.size() == 2 && name.empty()) return wrong("no name");
  if (name.empty()) {
    if (elevators.empty()) return wrong("there is no elevator");
    if (elevators.size() > 1) return wrong("say which elevator of " + join_names(elevators));
    name = elevators.front();
  }
  return sim::ToDevice{"elevator", name, {"Floor" + floor, {}}};
}

sim::Action any_action(const std::string& target, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return reject("command", "command", target + ": " + text, why,
                  "right is a device's name (or KIND/NAME) as target and its verb as text");
  };
  if (!valid_utf8(target) || !valid_utf8(text)) return wrong("not UTF-8");
  const std::string name = trimmed(target);
  if (name.empty()) return wrong("no target");
  Command command{trimmed(text), {}};
  if (command.text.empty()) return wrong("no text");
  std::vector<double> values;
  std::size_t start = 0;
  while (start < command.text.size()) {
    const std::size_t end = std::min(command.text.find_first_of(" ,", start), command.text.size());
    if (end > start) {
      const std::optional<double> value = parse_finite(command.text.substr(start, end - start));
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
