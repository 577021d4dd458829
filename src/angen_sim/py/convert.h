#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <vector>

#include "plugin/plugin.h"
#include "sim/snapshot.h"

namespace angen::py {

namespace pyb = pybind11;

/// Fields of a reading as a dict, with `kind` and `stamp` (s).
pyb::dict to_dict(const Reading& reading);

/// Sets a reading's fields to a dict's values; throws Error for a value of another type.
void from_dict(const pyb::dict& values, Reading& reading);

/// Six numbers x y z roll pitch yaw (m, rad) as a pose; throws Error for another count or NaN.
Pose to_pose(const std::vector<double>& xyzrpy);

/// x y z qx qy qz qw, m.
Eigen::Matrix<double, 1, 7> to_row(const Pose& pose);

}  // namespace angen::py
