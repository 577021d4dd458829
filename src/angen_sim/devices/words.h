#pragma once

#include <string>
#include <vector>

namespace angen::devices {

/// A command's text in lower case, split at spaces and commas.
std::vector<std::string> words_of(const std::string& text);

}  // namespace angen::devices
