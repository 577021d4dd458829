#pragma once

#include "core/element.h"

namespace angen::load {

/// Throws Error for a URDF <robot> whose links, joints or numbers are not as they must be, and for
/// one so large or deep that libsdformat would take minutes.
void check_robot(const Element& robot);

}  // namespace angen::load
