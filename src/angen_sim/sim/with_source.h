#pragma once

#include <utility>
#include <vector>

#include "core/diagnostics.h"

namespace angen::sim {

/// An error in a plug-in gets the plug-in's file and line, unless it has some already.
template <class F>
auto with_source(const Source& source, F&& make) {
  try {
    return make();
  } catch (const Error& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& d : diagnostics) {
      if (d.source.file.empty()) d.source = source;
    }
    throw Error(std::move(diagnostics));
  }
}

}  // namespace angen::sim
