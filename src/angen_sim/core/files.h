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

/// Writes a whole text to a file descriptor, also where signals interrupt it. False where it does
/// not fit, or fails; errno says why.
bool write_all(int file, const std::string& text);

/// Whether a path leads to a regular file of a disk. Files of /proc and /sys call themselves
/// regular, too, but reading them may block or never end. Opens nothing.
bool is_plain_file(const std::string& path);

/// Takes `key` for this process until it ends, however it ends; false where another one of the file
/// `path` has it. The file has no bytes: a key is a locked place in it, so that no files pile up.
/// Throws Error if the file cannot be opened or locked.
bool lock_until_exit(const std::string& path, const std::string& key);

}  // namespace angen
