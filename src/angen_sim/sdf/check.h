#pragma once

#include <string>
#include <vector>

#include "core/element.h"
#include "sdf/expand.h"

/// What is wrong with an expanded tree, found before libsdformat sees it. All throw Error.
namespace angen::load {

/// Names, numbers and flags of a world's settings and lights; models are left to check_model.
void check_settings(Element& world, Session& session);

/// Whether a model has a link, also in a nested model.
bool has_link(const Element& model);

/// Names, numbers, joints and geometries of an expanded model. A revolute joint with a zero axis is
/// rewritten as fixed, with a warning.
void check_model(Element& model, Session& session);

/// The same for a single <sensor> or <light>.
void check_part(Element& element, Session& session);

/// Every number and flag that SDF knows below `element`, plug-ins left out. What tunes the solver
/// is replaced by the nearest number that it can use, with a warning.
void check_values(Element& element, Session& session);

}  // namespace angen::load
