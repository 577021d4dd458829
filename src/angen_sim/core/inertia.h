#pragma once

#include <string>

#include "core/pose.h"

namespace angen {

/// Why no body has that mass (kg) and these moments of inertia (kg m^2), or the solver cannot use
/// them: each principal moment must be positive, none above the sum of the others, all within
/// limits. Empty for good ones.
std::string inertia_problem(double mass, const Eigen::Matrix3d& moment);

}  // namespace angen
