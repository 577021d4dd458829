#include "plugin/reading.h"

#include <iterator>

#include "core/diagnostics.h"
#include "core/nearest.h"

namespace angen {

const char* type_name(const Value& value) {
  constexpr const char* kNames[] = {"flag",  "integer", "number", "text",  "numbers",
                                    "texts", "image",   "image",  "choice"};
  static_assert(std::size(kNames) == std::variant_size_v<Value>);
  return kNames[value.index()];
}

void Reading::throw_missing(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& [known, value] : fields) names.push_back(known);
  throw Error("a reading of kind '" + kind + "' has no field '" + name + "'; " +
              did_you_mean(name, names));
}

void Reading::throw_type(const std::string& name, const Value& value, const Value& read_as) const {
  throw Error("the field '" + name + "' of kind '" + kind + "' has the type " + type_name(value) +
              ", and is read as " + type_name(read_as));
}

}  // namespace angen
