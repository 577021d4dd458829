#pragma once

#include <exception>
#include <string>

#include "core/text.h"

namespace angen::sim {

/// Calls a plug-in, which may throw anything. Returns the text of the exception, on one line; ""
/// where it did not throw.
template <class F>
std::string thrown_by(F&& call) {
  try {
    call();
    return "";
  } catch (const std::exception& problem) {
    const std::string what = printable(problem.what(), 200);
    return what.empty() ? "an exception without a message" : what;
  } catch (...) {
    return "an exception that is not a std::exception";
  }
}

}  // namespace angen::sim
