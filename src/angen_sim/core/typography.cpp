#include "core/typography.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "core/text.h"

namespace angen {

namespace {

struct Typographic {
  const char* bytes;
  const char* code;
  char plain;
};

constexpr std::array<Typographic, 31> kTypographic = {{
    {"\u2212", "U+2212", '-'},  {"\u2013", "U+2013", '-'},  {"\u2014", "U+2014", '-'},
    {"\u2010", "U+2010", '-'},  {"\u2011", "U+2011", '-'},  {"\u2012", "U+2012", '-'},
    {"\uFF0D", "U+FF0D", '-'},  {"\u201C", "U+201C", '"'},  {"\u201D", "U+201D", '"'},
    {"\u201E", "U+201E", '"'},  {"\u201F", "U+201F", '"'},  {"\u2033", "U+2033", '"'},
    {"\u00AB", "U+00AB", '"'},  {"\u00BB", "U+00BB", '"'},  {"\u2018", "U+2018", '\''},
    {"\u2019", "U+2019", '\''}, {"\u201A", "U+201A", '\''}, {"\u2032", "U+2032", '\''},
    {"\u00A0", "U+00A0", ' '},  {"\u2002", "U+2002", ' '},  {"\u2003", "U+2003", ' '},
    {"\u2004", "U+2004", ' '},  {"\u2005", "U+2005", ' '},  {"\u2006", "U+2006", ' '},
    {"\u2007", "U+2007", ' '},  {"\u2008", "U+2008", ' '},  {"\u2009", "U+2009", ' '},
    {"\u200A", "U+200A", ' '},  {"\u202F", "U+202F", ' '},  {"\u205F", "U+205F", ' '},
    {"\u3000", "U+3000", ' '},
}};

/// The start of the last character of a non-empty text: continuation bytes of UTF-8 are 10xxxxxx.
std::size_t last_character(const std::string& text) {
  std::size_t at = text.size() - 1;
  while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) --at;
  return at;
}

/// The character at a byte as ASCII has it, and its bytes.
std::pair<char, std::size_t> plain_at(const std::string& text, std::size_t at) {
  const std::optional<TypographicChar> found = find_typographic(text.substr(at, 4));
  if (found && found->at == 0) return {found->plain, found->size};
  return {text[at], 1};
}

}  // namespace

std::optional<TypographicChar> find_typographic(const std::string& text, std::size_t from) {
  const auto not_ascii = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  for (auto at = text.begin() + static_cast<std::ptrdiff_t>(std::min(from, text.size()));
       (at = std::find_if(at, text.end(), not_ascii)) != text.end(); ++at) {
    const auto offset = static_cast<std::size_t>(at - text.begin());
    for (const Typographic& one : kTypographic) {
      const std::string bytes = one.bytes;
      if (text.compare(offset, bytes.size(), bytes) != 0) continue;
      const std::string shown = one.plain == ' ' ? "a blank" : bytes;
      return TypographicChar{offset, bytes.size(), shown + " (" + one.code + ")", one.plain};
    }
  }
  return std::nullopt;
}

std::string without_typography(const std::string& text) {
  std::string plain;
  std::size_t begin = 0;
  for (auto found = find_typographic(text); found; found = find_typographic(text, begin)) {
    plain += text.substr(begin, found->at - begin) + found->plain;
    begin = found->at + found->size;
  }
  return plain + text.substr(begin);
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

std::optional<std::string> plain_numbers(const std::string& text) {
  if (!find_typographic(text)) return std::nullopt;
  const std::string plain = without_typography(text);
  std::istringstream words(plain);
  bool any = false;
  for (std::string word; words >> word; any = true) {
    if (!parse_number(word)) return std::nullopt;
  }
  return any ? std::optional<std::string>(plain) : std::nullopt;
}

}  // namespace angen
