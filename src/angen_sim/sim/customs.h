#pragma once

#include <string>
#include <vector>

#include "desc/world.h"
#include "plugin/params.h"

/// What the customs of a model say of errors in its plug-ins.
namespace angen::sim {

/// The texts of an error that does not stop the simulation.
std::vector<std::string> ignored(const Error& error);
/// The same, if the customs set wrong parts aside; otherwise throws the error.
std::vector<std::string> set_aside(const Error& error, const desc::Customs& customs);
/// The warnings of a plug-in that has read its parameters. One that was not read throws Error,
/// unless the customs set it aside.
std::vector<std::string> finish(const Params& params, const desc::Customs& customs);

}  // namespace angen::sim
