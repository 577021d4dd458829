#pragma once

#include <string>

namespace angen {

/// Takes `key` for this process until it ends, however it ends; false where another one of the file
/// `path` has it. The file has no bytes: a key is a locked place in it, so that no files pile up.
/// Throws Error if the file cannot be opened or locked.
bool lock_until_exit(const std::string& path, const std::string& key);

}  // namespace angen
