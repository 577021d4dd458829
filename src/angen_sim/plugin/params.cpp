#include "plugin/params.h"

#include <cmath>
#include <limits>
#include <optional>

#include "core/limits.h"
#include "core/lists.h"
#include "core/text.h"

namespace angen {

namespace {

// Parameters of Gazebo's own plug-ins; a plug-in that needs one of them reads it.
const std::set<std::string> kAlwaysKnown = {
    "alwaysOn",  "updateRate",      "update_rate",    "topicName",   "frameName",
    "visualize", "bumperTopicName", "robotNamespace", "device_name",
};

std::string shown(const Range& range) {
  std::string low = range.min == kPositive.min ? "> 0" : ">= " + number_text(range.min);
  std::string high = "<= " + number_text(range.max);
  if (!std::isfinite(range.max)) return low;
  return std::isfinite(range.min) ? low + " and " + high : high;
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

// The integer of a number without a fraction that fits.
std::optional<int> whole_part(const std::string& text) {
  constexpr double kLargest = std::numeric_limits<int>::max();
  const std::optional<double> value = parse_finite(text);
  if (!value || std::abs(*value) > kLargest) return std::nullopt;
  return static_cast<int>(*value);
}

void collect(const Element& parent, const std::string& path, std::vector<const Element*>& found) {
  const std::size_t slash = path.find('/');
  const std::string first = path.substr(0, slash);
  for (const Element& child : parent.children) {
    if (child.name != first) continue;
    if (slash == std::string::npos) {
      found.push_back(&child);
    } else {
      collect(child, path.substr(slash + 1), found);
    }
  }
}

std::vector<double> row_in(const Element& given, const std::string& path, std::size_t count,
                           const std::string& unit) {
  const auto rejected = [&](const std::string& what) {
    return Error(given.source, "<" + path + "> has " + what);
  };
  const Numbers found = numbers_in(given.text);
  if (!found.bad.empty()) throw rejected("\"" + found.bad + "\", must be a finite number");
  for (const double value : found.values) {
    const std::string text = number_text(value);
    if (!std::isfinite(value)) throw rejected("\"" + text + "\", must be a finite number");
    const std::string problem = limit_problem(limit_of_unit(unit), value);
    if (!problem.empty()) throw rejected(text + "; " + problem);
  }
  if (found.values.size() != count) {
    throw rejected(std::to_string(found.values.size()) + " numbers, must have " +
                   std::to_string(count) + (unit.empty() ? "" : " (" + unit + ")"));
  }
  return found.values;
}

}  // namespace

Params::Params(const Element& plugin, const Element* sensor, double rate)
    : plugin_(plugin), rate_(rate) {
  if (sensor != nullptr) sensor_ = *sensor;
}

std::vector<const Element*> Params::all(const std::string& path) const {
  std::vector<const Element*> found;
  collect(plugin_, path, found);
  if (found.empty()) collect(sensor_, path, found);
  return found;
}

void Params::note(const std::string& path, const std::string& type, const std::string& fallback,
                  const std::string& unit, const std::string& doc) {
  if (read_.insert(path).second) docs_.push_back({path, type, fallback, unit, doc, {}});
}

const Element* Params::take(const std::string& path, const std::string& type,
                            const std::string& fallback, const std::string& unit,
                            const std::string& doc) {
  note(path, type, fallback, unit, doc);
  const std::vector<const Element*> found = all(path);
  if (found.size() > 1) {
    const std::string twice = "<" + path + "> is given twice";
    if (!takes_first_) throw Error(found[1]->source, twice + ", one is enough");
    warnings_.push_back(
        {Diagnostic::Severity::kWarning, found[1]->source, twice + "; the first one is used"});
  }
  return found.empty() ? nullptr : found[0];
}

void Params::check_range(const std::string& path, const Element& given, double value,
                         const std::string& unit, Range range) const {
  if (range.contains(value)) return;
  throw error(path,
              "<" + path + "> is " + with_unit(given.text, unit) + ", must be " + shown(range));
}

double Params::number(const std::string& path, double fallback, const std::string& unit,
                      const std::string& doc, Range range) {
  const std::string shown_fallback = std::isnan(fallback) ? "" : number_text(fallback);  // none
  const Element* given = take(path, "number", shown_fallback, unit, doc);
  if (given == nullptr) return fallback;
  const std::optional<double> value = parse_finite(given->text);
  if (!value) {
    throw error(path, "<" + path + "> is \"" + given->text + "\", must be a finite number" +
                          (unit.empty() ? "" : " (" + unit + ")"));
  }
  check_range(path, *given, *value, unit, range);
  const std::string problem =
      limit_problem(limit_of_unit(unit), *value, range.min == kPositive.min);
  if (!problem.empty()) {
    throw error(path, "<" + path + "> is " + with_unit(given->text, unit) + "; " + problem);
  }
  return *value;
}

int Params::integer(const std::string& path, int fallback, const std::string& unit,
                    const std::string& doc, Range range) {
  const Element* given = take(path, "integer", std::to_string(fallback), unit, doc);
  if (given == nullptr) return fallback;
  std::optional<int> value = parse_integer(given->text);
  if (!value && takes_first_) {  // the first one, as Gazebo reads it
    value = whole_part(given->text);
    if (value) {
      warn(path, "<" + path + "> is \"" + given->text + "\", must be a whole number; " +
                     std::to_string(*value) + " is taken");
    }
  }
  if (!value) {
    throw error(path, "<" + path + "> is \"" + given->text + "\", must be a whole number");
  }
  check_range(path, *given, *value, unit, range);
  return *value;
}

bool Params::flag(const std::string& path, bool fallback, const std::string& doc) {
  const Element* given = take(path, "flag", fallback ? "true" : "false", "", doc);
  if (given == nullptr) return fallback;
  if (given->text == "true" || given->text == "1") return true;
  if (given->text == "false" || given->text == "0") return false;
  throw error(path, "<" + path + "> is \"" + given->text + "\", must be true or false");
}

std::string Params::text(const std::string& path, const std::string& fallback,
                         const std::string& doc) {
  const Element* given = take(path, "text", fallback, "", doc);
  return given == nullptr ? fallback : given->text;
}

std::string Params::choice(const std::string& path, const std::string& fallback,
                           const std::vector<std::string>& choices, const std::string& doc) {
  const Element* given = take(path, join_names(choices), fallback, "", doc);
  for (ParamDoc& known : docs_) {
    if (known.path == path) known.choices = choices;
  }
  if (given == nullptr) return fallback;
  if (!is_in(given->text, choices)) {
    throw error(path,
                "<" + path + "> is \"" + given->text + "\", must be one of " + join_names(choices));
  }
  return given->text;
}

std::vector<std::vector<double>> Params::rows(const std::string& path, std::size_t count,
                                              const std::string& unit, const std::string& doc) {
  note(path, std::to_string(count) + " numbers, any number of times", "", unit, doc);
  std::vector<std::vector<double>> result;
  for (const Element* given : all(path)) {
    result.push_back(row_in(*given, path, count, unit));
  }
  return result;
}

std::vector<double> Params::row(const std::string& path, const std::vector<double>& fallback,
                                const std::string& unit, const std::string& doc) {
  std::string numbers;
  for (const double each : fallback) {
    numbers += (numbers.empty() ? "" : " ") + number_text(each);
  }
  const Element* given =
      take(path, std::to_string(fallback.size()) + " numbers", numbers, unit, doc);
  return given == nullptr ? fallback : row_in(*given, path, fallback.size(), unit);
}

std::vector<std::string> Params::names(const std::string& path) const {
  std::vector<std::string> result;
  for (const Element* given : all(path)) result.push_back(given->attribute_text("name"));
  return result;
}

std::vector<std::string> Params::texts(const std::string& path, const std::string& unit,
                                       const std::string& doc) {
  note(path, "text, any number of times", "", unit, doc);
  std::vector<std::string> result;
  for (const Element* given : all(path)) result.push_back(given->text);
  return result;
}

Nanoseconds Params::update_period() {
  constexpr double kSlowest = 1e-6;  // Hz; a much slower rate has no period in nanoseconds
  std::string path = "update_rate";
  for (const char* other : {"odometryRate", "updateRateHZ", "updateRate"}) {
    if (has(other)) path = other;
  }
  const Range rates{0.0, 1e6};
  double rate = number(path, rate_, "Hz", "how often it publishes", rates);
  if (rate == 0.0 && path != "update_rate" && has("update_rate")) {
    path = "update_rate";
    rate = number(path, rate_, "Hz", "how often it publishes", rates);
  }
  if (rate > 0.0 && rate < kSlowest) {
    throw error(path, "<" + path + "> is " + number_text(rate) +
                          " Hz, must be 0 or >= " + number_text(kSlowest));
  }
  const double hz = rate > 0.0 ? rate : rate_;
  if (!(hz >= kSlowest && hz <= rates.max)) {
    throw error(path, "the rate of its kind is " + number_text(hz) + " Hz, must be from " +
                          number_text(kSlowest) + " to " + number_text(rates.max));
  }
  return from_seconds(1.0 / hz);
}

double Params::noise(const std::string& field, const std::string& unit, const std::string& doc,
                     bool relative) {
  Noise noise;
  noise.field = field;
  noise.stddev = number("noise_stddev", 0.0, unit, doc, kNotNegative);
  noise.relative = relative;
  noise_.push_back(noise);
  return noise.stddev;
}

bool Params::has(const std::string& path) const { return !all(path).empty(); }

Error Params::error(const std::string& path, const std::string& message) const {
  const std::vector<const Element*> found = all(path);
  return Error(found.empty() ? plugin_.source : found[0]->source, message);
}

void Params::warn(const std::string& path, const std::string& message) {
  warnings_.push_back(
      {Diagnostic::Severity::kWarning, error(path, "").diagnostics().front().source, message});
}

void Params::finish() const {
  const std::vector<Diagnostic> found = unread();
  if (!found.empty()) throw Error(found.front().source, found.front().message);
}

std::vector<Diagnostic> Params::unread() const {
  std::vector<Diagnostic> found;
  list_unread(plugin_, "", found);
  return found;
}

void Params::list_unread(const Element& parent, const std::string& prefix,
                         std::vector<Diagnostic>& to) const {
  for (const Element& child : parent.children) {
    const std::string path = prefix + child.name;
    if (child.name.find("::") != std::string::npos) continue;  // libsdformat's own
    if (read_.count(path) > 0 || (prefix.empty() && kAlwaysKnown.count(path) > 0)) continue;
    const auto below = read_.lower_bound(path + "/");
    if (below != read_.end() && below->compare(0, path.size() + 1, path + "/") == 0) {
      list_unread(child, path + "/", to);
      continue;
    }
    const std::string* file = plugin_.attribute("filename");
    std::vector<std::string> known;
    for (const ParamDoc& doc : docs_) known.push_back(doc.path);
    to.push_back({Diagnostic::Severity::kWarning, child.source,
                  "<" + path + "> is not a parameter of " +
                      (file != nullptr ? *file : "this plug-in") + "; known are " +
                      join_names(known)});
  }
}

}  // namespace angen
