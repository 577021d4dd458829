#pragma once

#include "core/photometry.h"

namespace angen::light {

/// Candela in a direction, between those given: `vertical` rad from where the
/// luminaire shines, `about` rad about that from its x axis. Beyond the
/// vertical angles given it is dark.
double intensity(const Photometry& luminaire, double vertical, double about);

/// lm, all that it emits.
double flux(const Photometry& luminaire);

}  // namespace angen::light
