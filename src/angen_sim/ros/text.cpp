#include "ros/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "core/diagnostics.h"

namespace angen::node {
namespace {

// Length of the UTF-8 character that starts at `i`, 0 where none does.
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

std::vector<std::string> fields_of(const std::string& text) {
  std::vector<std::string> fields;
  std::size_t start = 0;
  while (true) {
    const std::size_t comma = text.find(',', start);
    fields.push_back(trimmed(text.substr(start, comma - start)));
    if (comma == std::string::npos) return fields;
    start = comma + 1;
  }
}

std::optional<double> number(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') ++begin;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
  return value;
}

sim::Reject reject(const std::string& source, const std::string& kind, const std::string& text,
                   const std::string& why, const std::string& right) {
  return {source, kind, "`" + printable(text) + "`: " + why + "; " + right};
}

}  // namespace

bool valid_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

std::string trimmed(const std::string& text) {
  constexpr char kBlank[] = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string printable(const std::string& text, std::size_t limit) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const bool plain = length > 1 || (length == 1 && text[i] >= 0x20 && text[i] != 0x7F);
    if (out.size() + std::max<std::size_t>(length, 1) > limit) return out + "…";
    out += plain ? text.substr(i, length) : "?";
    i += std::max<std::size_t>(length, 1);
  }
  return out;
}

sim::Action topic_action(const Kind& kind, const std::string& text,
                         const std::vector<std::string>& names) {
  const std::string source = kind.command_topic.substr(kind.command_topic.rfind('/') + 1);
  const auto wrong = [&](const std::string& why) {
    return reject(source, kind.name, text, why,
                  "right is VERB, NAME[, NUMBER]; verbs are " + forms_of(kind));
  };
  if (!valid_utf8(text)) return wrong("not UTF-8");
  const std::vector<std::string> fields = fields_of(text);
  if (fields[0].empty()) return wrong("no verb");
  if (fields.size() > 3) return wrong("too many parts");
  std::string name = fields.size() > 1 ? fields[1] : "";
  if (fields.size() > 1 && name.empty()) return wrong("no name");
  if (name.empty() && names.size() == 1) name = names.front();
  Command command{fields[0] + (fields.size() > 2 ? " " + fields[2] : ""), {}, "", 0.0};
  const std::string reason = parse_command(kind, command);
  if (!reason.empty()) return wrong(printable(reason, 400));
  if (name.empty()) return wrong(names.empty() ? "there is no " + kind.name : "no name");
  return sim::ToDevice{kind.name, name, std::move(command)};
}

sim::Action any_action(const std::string& target, const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return reject("command", "command", target + ": " + text, why,
                  "right is a device's name (or KIND/NAME) as target and its verb as text");
  };
  if (!valid_utf8(target) || !valid_utf8(text)) return wrong("not UTF-8");
  const std::string name = trimmed(target);
  if (name.empty()) return wrong("no target");
  Command command{trimmed(text), {}, "", 0.0};
  if (command.text.empty()) return wrong("no text");
  std::vector<double> values;
  std::size_t start = 0;
  while (start < command.text.size()) {
    const std::size_t end = std::min(command.text.find_first_of(" ,", start), command.text.size());
    if (end > start) {
      const std::optional<double> value = number(command.text.substr(start, end - start));
      if (!value) {
        values.clear();
        break;
      }
      values.push_back(*value);
    }
    start = end + 1;
  }
  command.values = std::move(values);
  return sim::ToDevice{"", name, std::move(command)};
}

}  // namespace angen::node
