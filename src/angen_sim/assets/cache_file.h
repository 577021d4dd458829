#pragma once

#include <optional>
#include <string>

/// Files of the user's cache, in $XDG_CACHE_HOME/angen or ~/.cache/angen. They begin with a hash of
/// the rest, so a torn or damaged file is never read.
namespace angen::load {

/// The file of a `key`, empty if there is no cache: ANGEN_NO_CACHE is set, or there is
/// no home.
std::string cache_file(const std::string& key, const std::string& extension);

/// Its bytes, if it is whole; marks it as used.
std::optional<std::string> read_cache_file(const std::string& file);

/// Replaces it at once, and removes the files that were not used for the longest time if all take
/// more than 128 MB. Throws std::exception.
void write_cache_file(const std::string& file, const std::string& bytes);

/// Path, size and time of a file, empty if it does not exist.
std::string file_state(const std::string& path);

/// file_state() of the library that has `symbol`: another build may read the same files otherwise.
std::string library_state(const void* symbol);

}  // namespace angen::load
