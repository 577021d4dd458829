#pragma once

#include "core/element.h"
#include "sdf/expand.h"

/// Structure and poses of an expanded tree; other values are checked where they are read. All throw
/// Error.
namespace angen::load {

/// Names and poses of a world's settings and lights; models are left to check_model.
void check_settings(Element& world, Session& session);

/// True if a model has a link, also in a nested model.
bool has_link(const Element& model);

/// Names, poses and joints of an expanded model. A revolute joint with a zero axis is
/// rewritten as fixed, with a warning.
void check_model(Element& model, Session& session);

/// Names and poses of a single <sensor> or <light>.
void check_part(Element& element, Session& session);

/// Every <pose> below `element`, plug-ins left out. May correct one that is beyond the limits.
void check_poses(Element& element, Session& session);

}  // namespace angen::load
