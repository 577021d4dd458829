#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "desc/world.h"
#include "plugin/params.h"
#include "sim/guard.h"
#include "sim/instance.h"

namespace angen::sim {

/// Makes the devices of a model by the plug-ins of model and world, and the sensors that a
/// model's own plug-in is, and lamps of lights that none of them has, if the light has a level or
/// the model's customs say so. Throws Error for one that is wrong, unless they set it aside.
void make_devices(LiveModel& live, const std::vector<desc::Plugin>& world_plugins, Catalog& catalog,
                  std::vector<std::string>& warnings);

/// The lamp of a light without a plug-in, for that light as `live` describes it now: at the
/// level that it has, or at that of the start.
void remake_own_lamp(LiveModel& live, DeviceInstance& lamp, bool keep_level, Catalog& catalog,
                     std::vector<std::string>& warnings);

/// An error in a plug-in gets the plug-in's file and line, unless it has some already.
template <class F>
auto with_source(const Source& source, F&& make) {
  try {
    return make();
  } catch (const Error& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& d : diagnostics) {
      if (d.source.file.empty()) d.source = source;
    }
    throw Error(std::move(diagnostics));
  } catch (...) {
    throw Error(source, thrown());
  }
}

/// The texts of an error that does not stop the simulation.
std::vector<std::string> ignored(const Error& error);
/// The same, if the customs set wrong parts aside; otherwise throws the error.
std::vector<std::string> set_aside(const Error& error, const desc::Customs& customs);
/// The warnings of a plug-in that has read its parameters. One that was not read throws Error,
/// unless the customs set it aside.
std::vector<std::string> finish(const Params& params, const desc::Customs& customs);

}  // namespace angen::sim
