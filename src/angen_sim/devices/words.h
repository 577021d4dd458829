#pragma once

#include <optional>
#include <string>
#include <vector>

namespace angen::devices {

/// A command's text in lower case, split at spaces and commas.
std::vector<std::string> words_of(const std::string& text);

/// The whole word as a finite number in the C locale, or nothing.
std::optional<double> number_of(const std::string& word);

}  // namespace angen::devices
