#include "plugin/declared.h"

#include <algorithm>

#include "core/diagnostics.h"
#include "core/named.h"
#include "core/nearest.h"

namespace angen {

namespace {

bool has_type(Field::Type type, Value& value) {
  const auto* integer = std::get_if<std::int64_t>(&value);
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  if (type == Field::Type::kNumber && integer != nullptr) value = double(*integer);
  if (type == Field::Type::kTexts && numbers != nullptr && numbers->empty()) {
    value = std::vector<std::string>();
  }
  return std::string(type_name(value)) == name_of(type);
}

/// The types of the field, one for each value of a parameter that it is declared with.
std::vector<Field::Type> declared_types(const Kind& kind, const std::string& name) {
  std::vector<Field::Type> types;
  for (const Field& field : kind.fields) {
    if (field.name == name) types.push_back(field.type);
  }
  if (!types.empty()) return types;
  throw Error("kind '" + kind.name + "' does not declare the field '" + name + "'; " +
              did_you_mean(name, names_in(kind.fields)));
}

}  // namespace

void check_fields(const Kind& kind, Reading& reading) {
  if (kind.fields.empty()) return;
  for (auto& [name, value] : reading.fields) {
    const std::vector<Field::Type> types = declared_types(kind, name);
    if (std::any_of(types.begin(), types.end(),
                    [&value = value](Field::Type type) { return has_type(type, value); })) {
      continue;
    }
    throw Error("the field '" + name + "' is set to a value of type " + type_name(value) +
                "; kind '" + kind.name + "' declares it as " + name_of(types.front()));
  }
}

void check_noise(const Kind& kind, const std::vector<Noise>& noise) {
  if (kind.fields.empty()) return;
  for (const Noise& each : noise) {
    const Field::Type type = declared_types(kind, each.field).front();
    if (type == Field::Type::kNumber || type == Field::Type::kNumbers) continue;
    throw Error("the field '" + each.field + "' has noise; kind '" + kind.name +
                "' declares it as " + name_of(type) + ", must be number or numbers");
  }
}

}  // namespace angen
