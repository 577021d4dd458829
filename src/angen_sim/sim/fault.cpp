#include "sim/fault.h"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "core/diagnostics.h"
#include "core/lists.h"
#include "core/named.h"
#include "core/nearest.h"
#include "core/text.h"

namespace angen::sim {

namespace {

constexpr double kForeverSeconds = 1e9;
constexpr double kMaxAlarms = 1e6;  // false ones a day

/// The numbers that a kind of fault takes, those in brackets may be missing.
struct Form {
  const char* name;
  std::vector<std::string> needed;
  std::vector<std::string> optional;
};

const std::vector<Form>& forms() {
  static const std::vector<Form> all = {
      {"dropout", {"share"}, {}},
      {"stuck", {}, {"from", "lasts"}},
      {"false_alarm", {"per_day"}, {}},
      {"delay", {"by"}, {}},
      {"duplicate", {"share"}, {}},
      {"clock", {"seconds_per_day"}, {}},
      {"battery", {"lasts"}, {"from"}},
      {"moved", {}, {"from", "x", "y", "z", "roll", "pitch", "yaw"}},
  };
  return all;
}

double number(const std::string& key, const std::string& text, double low, double high) {
  const std::optional<double> value = parse_finite(text);
  if (!value || *value < low || *value > high) {
    throw Error("fault: " + key + "=" + printable(text) + " is not a number from " +
                number_text(low) + " to " + number_text(high));
  }
  return *value;
}

Nanoseconds seconds(const std::string& key, const std::string& text) {
  return static_cast<Nanoseconds>(number(key, text, 0.0, kForeverSeconds) * kSecond);
}

using Numbers = std::map<std::string, std::string>;

Numbers numbers_of(const Form& form, std::istringstream& words) {
  Numbers found;
  std::vector<std::string> known = form.needed;
  known.insert(known.end(), form.optional.begin(), form.optional.end());
  for (std::string word; words >> word;) {
    const std::size_t split = word.find('=');
    const std::string key = word.substr(0, split);
    if (split == std::string::npos || !is_in(key, known)) {
      throw Error(std::string("fault ") + form.name + ": '" + printable(word) +
                  "' is not one of its numbers, as " + known.front() + "=1; it takes " +
                  join_names(known));
    }
    found[key] = word.substr(split + 1);
  }
  for (const std::string& key : form.needed) {
    if (found.count(key) == 0) {
      throw Error(std::string("fault ") + form.name + ": " + key + "= is missing");
    }
  }
  return found;
}

Fault made_of(Fault::Kind kind, const Numbers& numbers) {
  Fault fault;
  fault.kind = kind;
  fault.lasts = static_cast<Nanoseconds>(kForeverSeconds) * kSecond;
  Vec3 turn = Vec3::Zero();
  for (const auto& [key, text] : numbers) {
    if (key == "share") fault.share = number(key, text, 0.0, 1.0);
    if (key == "per_day") fault.a_day = number(key, text, 0.0, kMaxAlarms);
    if (key == "seconds_per_day") fault.a_day = number(key, text, -1e4, 1e4);
    if (key == "from") fault.from = seconds(key, text);
    if (key == "lasts") fault.lasts = std::max<Nanoseconds>(seconds(key, text), 1);
    if (key == "by") {
      const std::size_t split = text.find('-', 1);
      fault.least = seconds(key, text.substr(0, split));
      fault.most = split == std::string::npos ? fault.least : seconds(key, text.substr(split + 1));
      if (fault.most < fault.least) throw Error("fault: by=" + printable(text) + " ends first");
    }
    const std::string places = "xyz";
    const std::size_t axis = key.size() == 1 ? places.find(key) : std::string::npos;
    if (axis != std::string::npos) fault.by.position[axis] = number(key, text, -100.0, 100.0);
    if (key == "roll") turn.x() = number(key, text, -7.0, 7.0);
    if (key == "pitch") turn.y() = number(key, text, -7.0, 7.0);
    if (key == "yaw") turn.z() = number(key, text, -7.0, 7.0);
  }
  fault.by.rotation = from_rpy(turn.x(), turn.y(), turn.z());
  return fault;
}

}  // namespace

const char* Fault::name() const { return forms()[static_cast<std::size_t>(kind)].name; }

std::vector<Fault> parse_faults(const std::string& text) {
  std::vector<Fault> found;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) {
    std::istringstream words(part);
    std::string name;
    if (!(words >> name)) continue;
    const auto form = index_in(forms(), name);
    if (!form) {
      throw Error("no fault '" + printable(name) + "'; " + did_you_mean(name, names_in(forms())));
    }
    found.push_back(made_of(static_cast<Fault::Kind>(*form), numbers_of(forms()[*form], words)));
  }
  return found;
}

}  // namespace angen::sim
