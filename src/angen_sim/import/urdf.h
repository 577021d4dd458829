#pragma once

#include <string>

#include "core/element.h"

namespace angen::load {

/// The element of an <axis> that has the numbers of a <safety_controller>.
constexpr char kSafety[] = "angen:safety_controller";

/// A URDF <robot> as the <sdf> element libsdformat makes of it. Lines are those of the URDF's
/// elements of the same name. `robot` is the parsed text. Throws Error.
Element convert_urdf(const std::string& text, const Element& robot);

}  // namespace angen::load
