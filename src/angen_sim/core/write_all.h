#pragma once

#include <string>

namespace angen {

/// Writes a whole text to a file descriptor, also where signals interrupt it. False where it does
/// not fit, or fails; errno says why.
bool write_all(int file, const std::string& text);

}  // namespace angen
