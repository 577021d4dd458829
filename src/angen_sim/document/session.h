#pragma once

#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/element.h"
#include "document/allowed.h"
#include "document/packages.h"
#include "document/search_paths.h"
#include "document/sources.h"

namespace angen::load {

/// The state of one load: search paths, files that it read, warnings, and counts for limits.
struct Session {
  /// An element was read by a Reader, may be read by others too, has no effect, or has none and a
  /// warning said so.
  enum class Mark { kRead, kOpen, kUnused, kWarned };

  const SearchPaths& paths;
  AllowedFiles allowed{paths};
  Sources sources{};
  std::vector<Diagnostic> warnings{};
  std::vector<Diagnostic> ignored{};           // elements that nothing reads
  std::set<std::string> warned_places{};       // of `warnings`, with their text
  std::set<std::string> ignored_places{};      // of `ignored`, as well
  std::set<std::string> converted{};           // URDF files: unread elements come from libsdformat
  std::size_t elements = 0;                    // elements of all documents
  std::optional<std::size_t> include_start{};  // `elements` before the outermost include
  double bytes = 0.0;                          // estimated memory of the expanded elements
  std::set<std::string> counted_files{};       // files of meshes that are counted in it
  std::vector<std::string> open{};             // documents being read, outermost first
  std::optional<Packages> packages{};          // once something was searched there
  bool tolerant = false;                       // as far as it is known; see decide()
  bool guessed = false;            // by a world's contents: its author may have misspelled
  std::vector<Error> tolerated{};  // errors that did not stop the load
  std::unordered_map<const Element*, Mark> read{};
  std::set<std::pair<const Element*, std::string>> read_attributes{};

  /// Once for each place: a file that is included ten times warns as often as if it were once.
  void warn(const Source& source, const std::string& message);
  void ignore(const Source& source, const std::string& what);
  /// Adds a warning if the document is tolerant, and throws the error otherwise.
  void warn_or_throw(const Error& error);
  /// Sets whether the document is tolerant; a strict one throws the first error that was tolerated.
  void decide(bool is_tolerant);
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
