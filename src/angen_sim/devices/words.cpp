#include "devices/words.h"

#include <cctype>

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

}  // namespace angen::devices
