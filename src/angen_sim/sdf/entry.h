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

/// Each entry's model, with its name, plug-ins and texts for `save`; the pose only of actors.
/// One that includes the same file as another in the same way is read once. Names must differ.
/// Throws Error; removes the entries that the dialect leaves out.
std::vector<desc::Model> describe_entries(std::vector<Entry>& entries, Session& session);

/// Adds the memory of an expanded <model>, <actor> or <light> to the session's sum: its
/// elements, links, sensors with their rays and pixels, and triangles of meshes and heightmaps by
/// the sizes of their files. Throws Error at it where the sum passes memory_limit().
void check_memory(const Element& expanded, Session& session);

}  // namespace angen::load
