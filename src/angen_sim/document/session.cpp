#include "document/session.h"

#include "core/text.h"

namespace angen::load {

void Session::warn(const Source& source, const std::string& message) {
  if (!warned_places.insert(place_of(source, message)).second) return;
  constexpr std::size_t kMaxBytes = 4000;  // it may repeat a user's input
  warnings.push_back({Diagnostic::Severity::kWarning, source,
                      message.size() <= kMaxBytes ? message : printable(message, kMaxBytes)});
}

void Session::ignore(const Source& source, const std::string& what) {
  if (converted.count(source.file) != 0) return;
  if (!ignored_places.insert(place_of(source, what)).second) return;
  ignored.push_back({Diagnostic::Severity::kWarning, source, what});
}

void Session::warn_or_throw(const Error& error) {
  if (!tolerant) throw Error(error);
  tolerated.push_back(error);
  for (const Diagnostic& each : error.diagnostics()) warn(each.source, each.message);
}

void Session::decide(bool is_tolerant) {
  tolerant = is_tolerant;
  if (!tolerant && !tolerated.empty()) throw Error(tolerated.front());
}

}  // namespace angen::load
