#include "core/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

namespace angen {

namespace {

// Length of the UTF-8 character that starts at `i`, 0 if none does.
std::size_t utf8_length(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xC0) != 0x80) return 0;
  }
  const unsigned char second = byte(i + 1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool surrogate = first == 0xED && second > 0x9F;
  const bool too_large = first == 0xF4 && second > 0x8F;
  return overlong || surrogate || too_large ? 0 : length;
}

bool is_tail(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::string length_of(const std::string& text) {
  return "… (" + std::to_string(text.size()) + " bytes)";
}

template <class T>
std::optional<T> parse(const std::string& text) {
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  const char* end = text.data() + text.size();
  T value{};
  const auto [stop, problem] = std::from_chars(begin, end, value);
  if (problem != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::size_t valid_utf8_prefix(const std::string& text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) break;
    i += length;
  }
  return i;
}

bool valid_utf8(const std::string& text) { return valid_utf8_prefix(text) == text.size(); }

std::string trimmed(const std::string& text) {
  constexpr char kBlank[] = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string shortened(const std::string& text, std::size_t limit) {
  if (text.size() <= limit) return text;
  constexpr std::size_t kMaxTails = 3;  // bytes of a character after its first
  std::size_t end = limit;
  while (end > 0 && limit - end < kMaxTails && is_tail(text[end])) --end;
  return text.substr(0, is_tail(text[end]) ? limit : end) + length_of(text);
}

std::string printable(const std::string& text, std::size_t limit) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const bool plain = length > 1 || (length == 1 && text[i] >= 0x20 && text[i] != 0x7F);
    if (out.size() + std::max<std::size_t>(length, 1) > limit) return out + length_of(text);
    out += plain ? text.substr(i, length) : "?";
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

std::optional<double> parse_number(const std::string& text) { return parse<double>(text); }

std::optional<double> parse_finite(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> parse_integer(const std::string& text) { return parse<int>(text); }

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Numbers numbers_in(const std::string& text) {
  Numbers found;
  for (const std::string& word : words_in(text)) {
    const std::optional<double> value = parse_number(word);
    if (!value) {
      found.bad = word;
      break;
    }
    found.values.push_back(*value);
  }
  return found;
}

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";  // whatever its sign
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof(buffer), value).ptr};
}

}  // namespace angen
