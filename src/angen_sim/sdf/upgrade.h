#pragma once

#include <string>

#include "document/session.h"

namespace angen::load {

/// Rewrites a tree of an older version (100..108) as SDF 1.9.
void upgrade(Element& sdf, int version, Session& session);

/// The group of siblings whose names must differ from that of `child`: all with this answer.
/// Links, joints, frames and models share theirs; "" where any name will do.
std::string names_shared_by(const Element& child);

}  // namespace angen::load
