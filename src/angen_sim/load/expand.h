#pragma once

#include <string>
#include <vector>

#include "core/element.h"
#include "load/load.h"

/// Documents as trees of SDF 1.9 with their includes written out, each element knowing its file.
namespace angen::load {

/// What one load carries along: where to search, what to say, how much was read.
struct Session {
  const SearchPaths& paths;
  std::vector<Diagnostic> warnings{};
  std::size_t elements = 0;         // of all documents so far
  std::vector<std::string> open{};  // documents being read, outermost first

  /// Once for each place: a file that is included ten times warns as often as if it were once.
  void warn(const Source& source, const std::string& message);
};

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

/// The <sdf> element of a text, upgraded to SDF 1.9 (URDF converted). `file` stands for it in
/// messages and, when it exists, is where relative addresses start.
Element read_document(const std::string& text, const std::string& file, Session& session);

/// What an <include> stands for: the included <model>, <actor> or <light> with the include's name,
/// pose, static and plug-ins, and with the includes inside it written out.
Element expand_include(const Element& include, Session& session);

/// Replaces every <include> inside a <model> by the model it stands for.
void expand_model(Element& model, Session& session);

/// Rewrites a tree of an older version (104..108) as SDF 1.9.
void upgrade(Element& sdf, int version);

}  // namespace angen::load
