#pragma once

#include <string>

namespace angen::load {

/// The element of SDF that an unknown one in `parent` most likely was to be: "waypoint" for
/// "waypont" in "trajectory". Empty if SDF has the element there, or none that is so near.
std::string meant_element(const std::string& name, const std::string& parent);

/// Why an element that nothing reads is wrong: "<waypont> in <trajectory> is not known; did you
/// mean <waypoint>?". Empty if SDF has it there, or if Angen uses nothing of `parent`.
std::string unknown_element(const std::string& name, const std::string& parent);

}  // namespace angen::load
