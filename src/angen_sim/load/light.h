#pragma once

#include "desc/world.h"
#include "load/session.h"

namespace angen::load {

/// A checked <light>; `pose` is where it stands in its link or the world.
desc::Light light_of(const Element& light, const Pose& pose, Session& session);

}  // namespace angen::load
