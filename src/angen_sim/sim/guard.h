#pragma once

#include <exception>
#include <string>

#include "core/text.h"

namespace angen::sim {

/// The text of the exception that is being handled, which may be anything, on one line.
inline std::string thrown() {
  try {
    throw;
  } catch (const std::exception& problem) {
    const std::string what = printable(problem.what(), 200);
    return what.empty() ? "an exception without a message" : what;
  } catch (...) {
    return "an exception that is not a std::exception";
  }
}

/// Calls a plug-in, which may throw anything. Returns the text of the exception; "" if there is
/// none.
template <class F>
std::string thrown_by(F&& call) {
  try {
    call();
    return "";
  } catch (...) {
    return thrown();
  }
}

}  // namespace angen::sim
