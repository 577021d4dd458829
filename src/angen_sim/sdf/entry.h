#pragma once

#include <vector>

#include "desc/world.h"
#include "sdf/expand.h"

namespace angen::load {

/// A <model>, <actor> or <include> as a file has it, and with includes expanded.
struct Entry {
  Element original;
  Element expanded;
  bool is_solid = false;  // has a collision with a shape, if that can be read
};

Entry expand_entry(const Element& element, Session& session);

/// Each entry's model, with its name, plug-ins and texts for `save`; the pose only of actors. One
/// that includes the same file as another in the same way is read once. Names must differ. Throws
/// Error; removes the entries that the dialect leaves out.
std::vector<desc::Model> describe_entries(std::vector<Entry>& entries, Session& session);

}  // namespace angen::load
