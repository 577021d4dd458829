#pragma once

#include <string>

/// Characters that PDFs and word processors have instead of ASCII's: minus signs and dashes, curly
/// quotes, blanks of other widths, and those that nobody sees.
namespace angen {

/// The text with ASCII's characters instead: “Dim, −1” is "Dim, -1".
std::string straightened(const std::string& text);

/// A text without blanks at its ends and quotes around it, of any kind: “Open, bathroom1” is
/// Open, bathroom1.
std::string unquoted(const std::string& text);

/// straightened() of a text of numbers only; other texts stay: names may contain dashes.
std::string plain_numbers(const std::string& text);

}  // namespace angen
