#pragma once

#include "core/photometry.h"

namespace angen::light {

/// Candela in a direction, interpolated linearly: `vertical` rad from the luminaire's axis, `about`
/// rad about the axis from x. 0 outside of the given vertical angles.
double intensity(const Photometry& luminaire, double vertical, double about);

/// Total luminous flux, lm.
double flux(const Photometry& luminaire);

}  // namespace angen::light
