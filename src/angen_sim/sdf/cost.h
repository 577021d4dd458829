#pragma once

#include "sdf/expand.h"

/// The memory that a file will take, estimated before it is allocated.
namespace angen::load {

/// Adds the memory of an expanded <model>, <actor> or <light> to the session's sum: its
/// elements, links, sensors with their rays and pixels, and triangles of meshes and heightmaps by
/// the sizes of their files. Throws Error at it where the sum passes memory_limit().
void check_memory(const Element& expanded, Session& session);

}  // namespace angen::load
