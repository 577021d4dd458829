#pragma once

#include <optional>
#include <string>

#include "record/json_line.h"
#include "sim/edit.h"

namespace angen::record {

/// x y z and the quaternion x y z w, to the bit.
std::vector<double> numbers_of(const Pose& pose);
/// Throws Error where the line has no such pose.
Pose pose_in(const LineReader& line);

/// An edit as a line of a log has it.
void write_edit(const sim::Edit& edit, LineWriter& line);
/// The edit of a line whose "do" is `what`; nothing where that is not an edit.
std::optional<sim::Edit> edit_in(const std::string& what, const LineReader& line);

}  // namespace angen::record
