#pragma once

#include <memory>

#include "plugin/library.h"
#include "py/convert.h"

namespace angen::py {

/// Binds Replay. `catalog`: of worlds whose models may name libraries anywhere, or on the plug-in
/// path only.
void bind_replay(pyb::module_& module, std::shared_ptr<Catalog> (*catalog)(bool any_path));

}  // namespace angen::py
