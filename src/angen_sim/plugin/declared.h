#pragma once

#include <vector>

#include "plugin/kind.h"
#include "plugin/noise.h"
#include "plugin/reading.h"

namespace angen {

/// Throws Error for a field that the kind does not declare, or declares with another type; it names
/// the nearest that it declares. Of a declared number, an integer becomes one; of declared texts,
/// an empty list of numbers. A kind that declares no fields has any.
void check_fields(const Kind& kind, Reading& reading);

/// check_fields() if a reading has other fields than the `checked` of its instance's last one:
/// names and types of fields stay.
inline void check_new_fields(const Kind& kind, Reading& reading, std::size_t& checked) {
  if (reading.fields.size() == checked) return;
  check_fields(kind, reading);
  checked = reading.fields.size();
}

/// Checks the fields that have noise: they must be numbers.
void check_noise(const Kind& kind, const std::vector<Noise>& noise);

}  // namespace angen
