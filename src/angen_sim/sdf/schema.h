#pragma once

#include "document/session.h"

namespace angen::load {

/// Throws the first error that libsdformat's schema finds in a <world> element of SDF 1.9 that has
/// passed the checks, as Error at the place the element came from; unknown elements are warnings.
/// Frames and poses are worked out by frames.h: libsdformat's graphs of them take time with the
/// square of a model's size.
void check_schema(const Element& world, Session& session);

}  // namespace angen::load
