#include "core/typography.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/text.h"

namespace angen {

namespace {

constexpr char kNothing = '\0';
constexpr std::pair<char, const char*> kTypographic[] = {
    {'-', "\u2212\u2013\u2014\u2010\u2011\u2012\uFF0D"},
    {'"', "\u201C\u201D\u201E\u201F\u2033\u00AB\u00BB"},
    {'\'', "\u2018\u2019\u201A\u2032"},
    {' ', "\u00A0\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200A\u202F\u205F\u3000"},
    {kNothing, "\u00AD\u200B\u2060\uFEFF"},
};

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

/// The start of the last character of a non-empty text.
std::size_t last_character(const std::string& text) {
  std::size_t at = text.size() - 1;
  while (at > 0 && continues(text[at])) --at;
  return at;
}

/// The character at a byte as ASCII has it, and its bytes; other characters are their first byte.
std::pair<char, std::size_t> plain_at(const std::string& text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && continues(text[end])) ++end;
  if (end == at + 1) return {text[at], 1};
  const std::string character = text.substr(at, end - at);
  for (const auto& [plain, others] : kTypographic) {
    if (std::strstr(others, character.c_str()) != nullptr) return {plain, end - at};
  }
  return {text[at], 1};
}

}  // namespace

std::string straightened(const std::string& text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const auto [character, size] = plain_at(text, at);
    if (character != kNothing || size == 1) plain += character;
    at += size;
  }
  return plain;
}

std::string unquoted(const std::string& text) {
  std::string rest = trimmed(text);
  while (!rest.empty()) {
    const std::size_t end = last_character(rest);
    const auto [first, first_size] = plain_at(rest, 0);
    const auto [last, last_size] = plain_at(rest, end);
    if (first == ' ') {
      rest.erase(0, first_size);
    } else if (last == ' ') {
      rest.erase(end);
    } else if ((first == '"' || first == '\'') && first == last && end > 0) {
      rest = trimmed(rest.substr(first_size, end - first_size));
    } else {
      break;
    }
  }
  return rest;
}

std::string plain_numbers(const std::string& text) {
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::all_of(text.begin(), text.end(), is_ascii)) return text;
  std::string plain = straightened(text);
  const Numbers numbers = numbers_in(plain);
  return numbers.values.empty() || !numbers.bad.empty() ? text : plain;
}

}  // namespace angen
