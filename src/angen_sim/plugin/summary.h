#pragma once

#include <string>
#include <vector>

#include "plugin/kind.h"
#include "plugin/reading.h"

namespace angen {

/// The fields of a reading or state that its kind shows, in a few words: "closed  0.4 mm". Where
/// the kind shows none, all numbers and texts as name=value.
std::string summary(const Kind& kind, const Reading& reading);

/// The values of the fields that are flags, integers or numbers, in the order of its kind; NaN of
/// a missing one.
std::vector<double> numbers(const Kind& kind, const Reading& reading);

/// Whether a field that is an alarm is yes.
bool alarms(const Kind& kind, const Reading& reading);

}  // namespace angen
