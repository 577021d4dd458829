#include "plugin/command.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/diagnostics.h"
#include "core/limits.h"
#include "core/text.h"
#include "core/typography.h"

namespace angen {

namespace {

/// Lower case, split at blanks and commas.
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

/// Whether a word is a number, and which.
bool parse_number(const std::string& word, bool whole, double& value) {
  const bool digits = word.find_first_not_of("0123456789") == std::string::npos;
  if (whole && (!digits || word.size() > 9)) return false;
  const std::optional<double> parsed = parse_finite(word);
  value = parsed.value_or(0.0);
  return parsed.has_value();
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// "0 to 100 percent", "radians".
std::string described(const Verb& verb) {
  std::string text = verb.argument;
  if (std::isfinite(verb.range.min) && std::isfinite(verb.range.max)) {
    text = text_of(verb.range.min) + " to " + text_of(verb.range.max) + " " + text;
  }
  return text;
}

std::string with_article(const std::string& kind) {
  const bool vowel = std::string("aeiou").find(kind[0]) != std::string::npos;
  return (vowel ? "an " : "a ") + kind;
}

/// The verb that the words begin with; an integer may follow it without a blank, which splits them.
const Verb* find_verb(const Kind& kind, std::vector<std::string>& words) {
  for (const Verb& verb : kind.verbs) {
    const std::string name = lower(verb.name);
    if (words[0] == name) return &verb;
    if (!verb.whole || words[0].compare(0, name.size(), name) != 0) continue;
    words.insert(words.begin() + 1, words[0].substr(name.size()));
    words[0] = name;
    return &verb;
  }
  return nullptr;
}

/// The words as numbers; none if one of them is not a finite number.
std::vector<double> numbers_of(const std::vector<std::string>& words) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    numbers.emplace_back();
    if (!parse_number(word, false, numbers.back())) return {};
  }
  return numbers;
}

/// The name of a place in a text: what follows the verb, if that does not begin with a number.
std::string place_in(const std::string& text, const std::vector<std::string>& words) {
  if (words.size() < 2 || angen::parse_number(words[1]).has_value()) return "";
  const std::size_t blank = text.find_first_of(" \t,");
  return blank == std::string::npos ? "" : unquoted(trimmed(text.substr(blank + 1)));
}

/// Whether the command is as many finite numbers as the kind takes; they are put into its values.
bool takes_values(const Kind& kind, const std::vector<std::string>& words, Command& command) {
  if (kind.value_units().empty()) return false;
  std::vector<double> values = command.values.empty() ? numbers_of(words) : command.values;
  const bool finite =
      std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (values.size() != kind.value_units().size() || !finite) return false;
  command.values = std::move(values);
  return true;
}

/// Says which value is beyond the limit of its unit; "" if none is.
std::string values_problem(const Kind& kind, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string problem = limit_problem(limit_of_unit(kind.value_units()[i]), values[i]);
    if (!problem.empty()) return number_text(values[i]) + " is out of range: " + problem;
  }
  return "";
}

}  // namespace

std::string forms_of(const Kind& kind) {
  std::vector<std::string> forms;
  for (const Verb& verb : kind.verbs) {
    std::string number = verb.argument.empty() ? "" : "<" + described(verb) + ">";
    for (std::size_t at = 0; verb.count > 1 && (at = number.find(' ', at)) != std::string::npos;) {
      number.replace(at, 1, "> <");
      at += 3;
    }
    if (verb.is_place) number += " [<floor>] or <name of a room or thing>";
    if (verb.is_optional) forms.push_back(verb.name);
    forms.push_back(verb.name + (number.empty() || verb.whole ? "" : " ") + number);
  }
  std::string values;
  for (const std::string& unit : kind.value_units())
    values += (values.empty() ? "<" : " <") + unit + ">";
  if (!values.empty()) forms.push_back(values);
  return join_names(forms);
}

bool is_verb(const Kind& kind, const std::string& text) {
  std::vector<std::string> words = words_of(text);
  const Verb* verb = words.empty() ? nullptr : find_verb(kind, words);
  double number = 0.0;
  return verb != nullptr && (words.size() == 1 || (verb->whole && words.size() == 2 &&
                                                   parse_number(words[1], true, number)));
}

std::string parse_command(const Kind& kind, Command& command) {
  const std::string text = unquoted(straightened(command.text));
  std::vector<std::string> words = words_of(text);
  if (kind.verbs.empty() && kind.value_units().empty()) {
    if (command.values.empty()) command.values = numbers_of(words);
    return "";
  }
  const std::string right = with_article(kind.name) + " takes " + forms_of(kind);
  command.text = text;
  if (takes_values(kind, words, command)) return values_problem(kind, command.values);
  if (words.empty() && !command.values.empty()) return "numbers without a verb; " + right;
  if (words.empty()) return "no verb; " + right;
  const Verb* verb = find_verb(kind, words);
  if (verb == nullptr) return "unknown verb '" + printable(words[0]) + "'; " + right;
  command.verb = verb->name;
  if (verb->name == "Stop") command.values.assign(kind.value_units().size(), 0.0);
  if (verb->is_place) command.place = place_in(trimmed(text), words);
  if (!command.place.empty() || (verb->is_optional && words.size() == 1)) return "";
  const bool has_floor = verb->is_place && words.size() == verb->count + 2;
  const std::size_t expected =
      verb->argument.empty() ? 1 : 1 + verb->count + static_cast<std::size_t>(has_floor);
  if (words.size() > expected) return "too many words after " + verb->name + "; " + right;
  if (words.size() < expected) return verb->name + " without " + verb->argument + "; " + right;
  std::vector<double> numbers;
  for (std::size_t i = 1; i < expected; ++i) {
    numbers.emplace_back();
    if (!parse_number(words[i], verb->whole, numbers.back())) {
      return "'" + printable(words[i]) + "' is not a number of " + verb->argument + "; " + right;
    }
    if (!verb->range.contains(numbers.back())) {
      return printable(words[i]) + " is out of range; " + right;
    }
    const std::string problem = limit_problem(limit_of_unit(verb->unit), numbers.back());
    if (!problem.empty()) return printable(words[i]) + " is out of range: " + problem;
  }
  if (!numbers.empty()) command.number = numbers.front();
  if (numbers.size() > 1) command.values = std::move(numbers);
  return "";
}

}  // namespace angen
