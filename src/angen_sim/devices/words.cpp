#include "devices/words.h"

#include <cctype>
#include <charconv>
#include <cmath>

namespace angen::devices {

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool separates = std::isspace(byte) != 0 || c == ',';
    if (!separates && !inside) words.emplace_back();
    if (!separates) words.back() += static_cast<char>(std::tolower(byte));
    inside = !separates;
  }
  return words;
}

std::optional<double> number_of(const std::string& word) {
  const char* begin = word.data();
  const char* end = begin + word.size();
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') ++begin;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace angen::devices
