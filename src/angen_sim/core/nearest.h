#pragma once

#include <string>
#include <vector>

namespace angen {

/// The edit distance of two names (Levenshtein 1966), whatever their case.
std::size_t edits(const std::string& a, const std::string& b);

/// The `count` names that are nearest to `name` by edit distance, the nearest first.
std::vector<std::string> nearest_names(const std::string& name, std::vector<std::string> known,
                                       std::size_t count = 3);

/// "did you mean bathroom0, bathroom1 or bedroom0?", or "there are none" where nothing is known.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& known);

}  // namespace angen
