#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "plugin/plugin.h"
#include "sim/snapshot.h"

namespace angen::py {

namespace pyb = pybind11;

/// Fields of a reading as a dict, with `kind` and `stamp` (s).
pyb::dict to_dict(const Reading& reading);

/// A dict's values into a reading's fields; throws Error for what cannot be one.
void from_dict(const pyb::dict& values, Reading& reading);

/// Six numbers x y z roll pitch yaw (m, rad) as a pose; throws Error for another count or NaN.
Pose to_pose(const std::vector<double>& xyzrpy);

/// x y z qx qy qz qw, m.
Eigen::Matrix<double, 1, 7> to_row(const Pose& pose);

}  // namespace angen::py
