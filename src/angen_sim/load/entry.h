#pragma once

#include <map>
#include <string>

#include "desc/world.h"
#include "load/expand.h"

namespace angen::load {

/// A <model>, <actor> or <include> as it stands in a file, and what it stands for.
struct Entry {
  Element original;
  Element expanded;
};

Entry expand_entry(const Element& element, Session& session);

/// Describes entries; one that includes the same file as another in the same way is described once.
class Describer {
 public:
  explicit Describer(Session& session) : session_(session) {}

  /// With name, plug-ins and texts for `save`; the pose only of actors. Throws Error.
  desc::Model describe(Entry& entry);

 private:
  desc::Model describe_once(const Element& model);

  Session& session_;
  std::map<std::string, desc::Model> known_;
};

}  // namespace angen::load
