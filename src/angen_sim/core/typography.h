#pragma once

#include <cstddef>
#include <optional>
#include <string>

/// Characters that PDFs and word processors put in the place of ASCII's: minus signs and dashes,
/// curly quotes, blanks of other widths.
namespace angen {

struct TypographicChar {
  std::size_t at = 0;    // byte
  std::size_t size = 0;  // bytes
  std::string name;      // "− (U+2212)"
  char plain = ' ';      // its ASCII replacement
};

/// The first one at or after the byte `from`.
std::optional<TypographicChar> find_typographic(const std::string& text, std::size_t from = 0);

/// The text with ASCII's characters in their place.
std::string without_typography(const std::string& text);

/// A text without blanks at its ends and quotes around it, of any kind: “Open, bathroom1” is
/// Open, bathroom1.
std::string unquoted(const std::string& text);

/// The numbers of a text of numbers only, with ASCII's characters: "−1.2 0" is "-1.2 0".
/// Empty where the text has no typographic character, or something besides numbers.
std::optional<std::string> plain_numbers(const std::string& text);

}  // namespace angen
