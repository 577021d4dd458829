#pragma once

#include "desc/world.h"
#include "document/session.h"

namespace angen::load {

/// A checked <light>; `pose` is its pose in its link or the world.
desc::Light light_of(const Element& light, const Pose& pose, Session& session);

/// A text that light() reads, as an element of a world of SDF 1.9.
Element light_element(const std::string& what, const std::string& name);

}  // namespace angen::load
