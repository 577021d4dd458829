#pragma once

#include <string>
#include <vector>

#include "core/element.h"
#include "document/session.h"

namespace angen::load {

/// Notes in the session what nothing reads of a <world>, <model>, <actor>, <include> or <light> and
/// of all that is below it: elements and attributes, each once for its place. What a
/// plug-in of others may read of a <sensor> is left out.
void note_ignored(const Element& element, Session& session);

}  // namespace angen::load
