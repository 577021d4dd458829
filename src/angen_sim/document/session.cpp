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

void Session::forget(const Element& element) {
  read.erase(&element);
  for (const auto& [name, value] : element.attributes) read_attributes.erase({&element, name});
  for (const Element& child : element.children) forget(child);
}

}  // namespace angen::load
