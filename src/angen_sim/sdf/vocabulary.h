#pragma once

#include <string>

namespace angen::load {

/// The element of SDF that an unknown one in `parent` most likely was to be: "waypoint" for
/// "waypont" in "trajectory". Empty where SDF has the element there, or none that is so near.
std::string meant_element(const std::string& name, const std::string& parent);

/// "<waypont> in <trajectory> is not known; did you mean <waypoint>?"; empty as above.
std::string misspelling(const std::string& name, const std::string& parent);

}  // namespace angen::load
