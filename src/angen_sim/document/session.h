#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/element.h"
#include "document/allowed.h"
#include "document/dialect.h"
#include "document/packages.h"

namespace angen::load {

/// Too much for a document of any dialect.
class LimitError : public Error {
 public:
  using Error::Error;
};

/// The state of one load: search paths, warnings, and counts for limits.
struct Session {
  /// An element was read by a Reader, may be read by others too, has no effect, or has none and a
  /// warning said so.
  enum class Mark { kRead, kOpen, kUnused, kWarned };

  const SearchPaths& paths;
  const Dialect* dialect = &own_dialect();
  AllowedFiles allowed{paths};
  std::vector<Diagnostic> warnings{};
  std::vector<Diagnostic> ignored{};           // elements that nothing reads
  std::set<std::string> warned_places{};       // places of `warnings`, with their text
  std::set<std::string> ignored_places{};      // places of `ignored`, with their text
  std::set<std::string> converted{};           // URDF files: unread elements come from libsdformat
  std::size_t elements = 0;                    // elements of all documents
  std::optional<std::size_t> include_start{};  // `elements` before the outermost include
  double bytes = 0.0;                          // estimated memory of the expanded elements
  std::set<std::string> counted_files{};       // files of meshes that are counted in it
  std::vector<std::string> open{};             // documents being read, outermost first
  std::optional<Packages> packages{};          // once something was searched there
  std::vector<Error> set_aside{};              // errors that did not stop the load
  std::unordered_map<const Element*, Mark> read{};
  std::set<std::pair<const Element*, std::string>> read_attributes{};

  /// Once for each place: a file that is included ten times warns as often as if it were once.
  void warn(const Source& source, const std::string& message);
  void ignore(const Source& source, const std::string& what);
  /// Forgets what was read below an element: another may be made at the same address.
  void forget(const Element& element);
  /// Dialect::report and read, of this session's.
  void warn_or_throw(const Error& error) { dialect->report(error, *this); }
  bool read_without_errors(const std::vector<Element*>& roots, const std::function<void()>& read) {
    return dialect->read(roots, *this, read);
  }
};

inline std::string place_of(const Source& source, const std::string& text) {
  return source.file + ":" + std::to_string(source.line) + ":" + text;
}

/// Keeps a document on the list of open ones while it is read.
class Open {
 public:
  Open(Session& session, const std::string& file) : session_(session) {
    session_.open.push_back(file);
  }
  ~Open() { session_.open.pop_back(); }
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;

 private:
  Session& session_;
};

}  // namespace angen::load
