#pragma once

#include <string>
#include <vector>

#include "core/element.h"
#include "core/pose.h"
#include "core/text.h"

/// Numbers, flags and poses out of elements' texts; a wrong one throws Error with file and line.
namespace angen::load {

/// Exactly `count` finite numbers.
std::vector<double> numbers_of(const Element& element, std::size_t count);
double number_of(const Element& element);
bool flag_of(const Element& element);

/// x y z roll pitch yaw (radians, or degrees where the attribute says so), or x y z and a
/// quaternion (rotation_format="quat_xyzw"). Empty is the identity.
Pose pose_of(const Element& element);

/// Optional children; `fallback` when there is none.
double child_number(const Element& element, const std::string& name, double fallback);
bool child_flag(const Element& element, const std::string& name, bool fallback);
Pose child_pose(const Element& element);

/// "x y z roll pitch yaw", to 1e-12.
std::string pose_text(const Pose& pose);

}  // namespace angen::load
