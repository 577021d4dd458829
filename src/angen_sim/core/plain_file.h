#pragma once

#include <string>

namespace angen {

/// Whether a path leads to a regular file of a disk. Files of /proc and /sys call themselves
/// regular, too, but reading them may block or never end. Opens nothing.
bool is_plain_file(const std::string& path);

}  // namespace angen
