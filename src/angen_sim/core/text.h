#pragma once

#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace angen {

/// The number of leading bytes that are whole UTF-8 characters: text.size() if all are valid.
std::size_t valid_utf8_prefix(const std::string& text);
bool valid_utf8(const std::string& text);

/// Without blanks (space, tab, line breaks) at both ends.
std::string trimmed(const std::string& text);

/// The whole text where it has at most `limit` bytes; else its beginning up to there, without a
/// part of a character, and its length: "Open, kitch… (1000000 bytes)".
std::string shortened(const std::string& text, std::size_t limit);

/// The text for a log line: shortened, control characters and invalid UTF-8 as `?`.
std::string printable(const std::string& text, std::size_t limit = 80);

/// The whole text as a number in the C locale, which may be infinite or NaN; a leading + is
/// allowed.
std::optional<double> parse_number(const std::string& text);
/// parse_number(), but none for infinity and NaN.
std::optional<double> parse_finite(const std::string& text);
std::optional<int> parse_integer(const std::string& text);

/// The words of a text, which blanks divide.
std::vector<std::string> words_in(const std::string& text);

/// The numbers of a text, up to the first word that is not one.
struct Numbers {
  std::vector<double> values;
  std::string bad;  // the first word that is not a number, empty when all are
};
Numbers numbers_in(const std::string& text);

/// The shortest text that parse_number() reads as the same value.
std::string number_text(double value);

/// The parts one after the other, for people: numbers have 6 digits at most.
template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace angen
