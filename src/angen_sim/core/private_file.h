#pragma once

#include <string>

/// Files that a program writes without a request of the user.
namespace angen {

/// $XDG_STATE_HOME/angen, or ~/.local/state/angen (XDG base directory specification).
std::string state_folder();

/// Makes a folder that this user alone may use, and its missing parents. Throws Error if it is a
/// link or belongs to another user.
void make_private_folder(const std::string& folder);

/// Replaces a file by one of these bytes that this user alone may read, all of it or nothing. Links
/// are replaced, too, never followed. Throws Error.
void write_private_file(const std::string& path, const std::string& bytes);

}  // namespace angen
