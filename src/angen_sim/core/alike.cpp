#include "core/alike.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <utility>

#include "core/lists.h"

namespace angen {

namespace {

constexpr std::size_t kFewMessages = 3;
constexpr std::size_t kFewNames = 10;

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// The message without quoted parts and digits.
std::string reason_of(const std::string& message) {
  std::string reason;
  char quote = '\0';
  for (const char c : message) {
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '\'' || c == '"') {
      quote = c;
      reason += c;
    } else if (!is_digit(c)) {
      reason += c;
    }
  }
  return reason;
}

// The first quoted part, with its quotes; empty if there is none.
std::string name_in(const std::string& message) {
  const std::size_t begin = message.find_first_of("'\"");
  if (begin == std::string::npos) return {};
  return message.substr(begin, message.find(message[begin], begin + 1) - begin + 1);
}

// Names in these messages, each once, but for that of the first.
std::string other_names(const std::vector<const Diagnostic*>& group) {
  std::vector<std::string> names{name_in(group.front()->message)};
  for (const Diagnostic* each : group) {
    const std::string name = name_in(each->message);
    if (!is_in(name, names)) names.push_back(name);
  }
  std::string text;
  for (std::size_t i = 1; i < std::min(names.size(), kFewNames + 1); ++i) {
    text += (i == 1 ? ": " : ", ") + names[i];
  }
  return names.size() > kFewNames + 1 ? text + ", …" : text;
}

// FILE:LINE: MESSAGE; a text of another form has no file.
Diagnostic parsed(const std::string& text) {
  Diagnostic out{Diagnostic::Severity::kWarning, {}, text};
  for (std::size_t at = text.find(": "); at != std::string::npos; at = text.find(": ", at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && is_digit(text[begin - 1])) --begin;
    if (begin == at || begin < 2 || text[begin - 1] != ':') continue;
    out.source = {text.substr(0, begin - 1), std::atoi(text.c_str() + begin)};
    out.message = text.substr(at + 2);
    break;
  }
  return out;
}

}  // namespace

std::vector<Diagnostic> merge_alike(const std::vector<Diagnostic>& all) {
  using Key = std::pair<std::string, std::string>;  // file and reason
  const auto key_of = [](const Diagnostic& each) {
    return Key{each.source.file, reason_of(each.message)};
  };
  std::map<Key, std::vector<const Diagnostic*>> groups;
  for (const Diagnostic& each : all) groups[key_of(each)].push_back(&each);
  std::vector<Diagnostic> merged;
  for (const Diagnostic& each : all) {
    const std::vector<const Diagnostic*>& group = groups[key_of(each)];
    if (group.size() <= kFewMessages) {
      merged.push_back(each);
    } else if (group.front() == &each) {
      int last = 0;
      for (const Diagnostic* other : group) last = std::max(last, other->source.line);
      merged.push_back(each);
      merged.back().message += " (and " + std::to_string(group.size() - 1) +
                               " more like it, up to line " + std::to_string(last) +
                               other_names(group) + ")";
    }
  }
  return merged;
}

std::vector<std::string> merge_alike(const std::vector<std::string>& all) {
  std::vector<Diagnostic> parts;
  for (const std::string& each : all) parts.push_back(parsed(each));
  std::vector<std::string> merged;
  for (const Diagnostic& each : merge_alike(parts)) merged.push_back(each.text());
  return merged;
}

}  // namespace angen
