#include "core/diagnostics.h"

#include <algorithm>
#include <utility>

#include "core/text.h"

namespace angen {

std::string Diagnostic::text() const {
  if (source.file.empty()) return message;
  if (source.line <= 0) return source.file + ": " + message;
  return source.file + ":" + std::to_string(source.line) + ": " + message;
}

namespace {

// A message quotes input of any length. A quote that is cut ends with its full length.
constexpr std::size_t kMaxMessageBytes = 3960;

std::string cut(const std::string& message) {
  return message.size() <= kMaxMessageBytes ? message : printable(message, kMaxMessageBytes);
}

std::string lines_of(const std::vector<Diagnostic>& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics) all += (all.empty() ? "" : "\n") + d.text();
  return all;
}

}  // namespace

Error::Error(std::string message) : Error(Source{}, std::move(message)) {}

Error::Error(Source source, std::string message)
    : Error(std::vector<Diagnostic>{
          {Diagnostic::Severity::kError, std::move(source), cut(std::move(message))}}) {}

Error::Error(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(lines_of(diagnostics)), diagnostics_(std::move(diagnostics)) {}

std::string join_names(const std::vector<std::string>& names, std::size_t limit) {
  if (names.empty()) return "(none)";
  std::string all;
  for (std::size_t i = 0; i < std::min(limit, names.size()); ++i) {
    all += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() > limit) all += " and " + std::to_string(names.size() - limit) + " more";
  return all;
}

}  // namespace angen
