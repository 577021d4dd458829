#pragma once

#include <Eigen/Core>

#include "plugin/kind.h"
#include "plugin/params.h"

namespace angen {

/// Reads <color> of a sensor whose rays rviz draws: r g b and, if it is given, alpha, each 0 to 1.
Eigen::Vector4f read_ray_color(Params& params, const Kind& kind);

}  // namespace angen
