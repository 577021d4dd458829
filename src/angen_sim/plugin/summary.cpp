#include "plugin/summary.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <type_traits>

namespace angen {

namespace {

constexpr char kNone[] = "–";  // a missing value, such as the temperature without a climate

std::string fixed(double value, int decimals) {
  if (std::isnan(value)) return kNone;
  std::ostringstream text;
  const double scale = std::pow(10.0, decimals);
  const double rounded = std::round(value * scale) / scale + 0.0;  // never -0
  text << std::fixed << std::setprecision(decimals) << (std::isfinite(value) ? rounded : value);
  return text.str();
}

std::string shown_value(const Field& field, const Value& value) {
  const std::string unit = field.unit.empty() ? "" : " " + field.unit;
  const auto joined = [&](const auto& values, const auto& show) {
    std::string all;
    for (const auto& each : values) all += (all.empty() ? "" : " ") + show(each);
    return all.empty() ? "none" : all + unit;
  };
  return std::visit(
      [&](const auto& held) -> std::string {
        using T = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<T, bool>) {
          if (field.words.size() == 2) return field.words[held ? 0 : 1];
          return held ? "yes" : "no";
        } else if constexpr (std::is_same_v<T, std::int64_t>) {
          return std::to_string(held) + unit;
        } else if constexpr (std::is_same_v<T, double>) {
          if (std::isnan(held)) return kNone;
          if (field.as_percent) return fixed(100.0 * held, field.decimals) + " %";
          return fixed(held, field.decimals) + unit;
        } else if constexpr (std::is_same_v<T, std::string>) {
          return held;
        } else if constexpr (std::is_same_v<T, Choice>) {
          return held.name;
        } else if constexpr (std::is_same_v<T, std::vector<double>>) {
          return joined(held, [&](double v) { return fixed(v, field.decimals); });
        } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
          return joined(held, [](const std::string& v) { return v; });
        }
        return "";
      },
      value);
}

bool is_scalar(const Field& field) {
  return field.type == Field::Type::kFlag || field.type == Field::Type::kInteger ||
         field.type == Field::Type::kNumber;
}

double number_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1.0 : 0.0;
  return std::numeric_limits<double>::quiet_NaN();
}

// "kitchen 20.1, bedroom 18.0 °C", or the values alone where their names are missing.
std::string shown_field(const Field& field, const Value& value, const Reading& reading) {
  const auto names = reading.get<std::vector<std::string>>(field.names, {});
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  if (numbers == nullptr || numbers->empty() || names.size() != numbers->size()) {
    return shown_value(field, value);
  }
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    all += (all.empty() ? "" : ", ") + names[i] + " " + fixed((*numbers)[i], field.decimals);
  }
  return field.unit.empty() ? all : all + " " + field.unit;
}

}  // namespace

std::string summary(const Kind& kind, const Reading& reading) {
  if (const auto error = reading.get<std::string>(kErrorField, ""); !error.empty()) {
    return "failed: " + error;
  }
  std::string text;
  const auto append = [&](const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "  ") + part;
  };
  for (const Field& field : kind.fields) {
    if (!field.in_summary) continue;
    if (const Value* value = reading.find(field.name)) append(shown_field(field, *value, reading));
  }
  if (!text.empty()) return text;
  for (const auto& [name, value] : reading.fields) {
    Field field;
    field.decimals = 2;
    const std::string shown = shown_value(field, value);
    std::string part = name;
    if (!shown.empty()) append(part.append("=").append(shown));
  }
  return text;
}

std::vector<double> numbers(const Kind& kind, const Reading& reading) {
  std::vector<double> values;
  for (const Field& field : kind.fields) {
    if (!is_scalar(field)) continue;
    const Value* value = reading.find(field.name);
    values.push_back(value != nullptr ? number_of(*value)
                                      : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

bool alarms(const Kind& kind, const Reading& reading) {
  for (const Field& field : kind.fields) {
    if (field.alarm && reading.get<bool>(field.name, false)) return true;
  }
  return false;
}

}  // namespace angen
