#pragma once

#include <string>

#include "core/text.h"
#include "desc/world.h"

/// Properties of lights that SDF does not define: brightness, and the plug-in of lights without
/// one.
namespace angen::desc {

// SDF gives lights no photometric unit: intensity 1 at full diffuse means a common lamp, or
// overcast daylight.
constexpr double kPointFlux = 800.0;             // lm
constexpr double kDirectionalIlluminance = 1e3;  // lx

/// Whether the light can be lit; a black one is dark at any level.
inline bool shines(const Light& light) {
  return light.intensity > 0.0 && light.diffuse.maxCoeff() > 0.0F;
}

/// At full level: lm in all directions; lx for a directional light. A black light counts as a white
/// one of intensity 1.
inline double brightness(const Light& light) {
  const double given = shines(light) ? light.intensity * light.diffuse.maxCoeff() : 1.0;
  return given * (light.type == Light::Type::kDirectional ? kDirectionalIlluminance : kPointFlux);
}

/// The plug-in that makes a lamp called `name` of a light.
inline Plugin own_lamp(const Light& light, const std::string& name, double level) {
  const bool directional = light.type == Light::Type::kDirectional;
  Plugin plugin{"lamp", "libros_plugin.so", {}, light.source, false};
  plugin.element.name = "plugin";
  plugin.element.source = light.source;
  plugin.element.attributes = {{"name", plugin.name}, {"filename", plugin.filename}};
  const auto set = [&](const char* param, const std::string& value) {
    plugin.element.children.push_back({param, value, {}, {}, light.source});
  };
  set("device_name", name);
  set("light", light.name);
  set(directional ? "illuminance" : "luminous_flux", number_text(brightness(light)));
  set("level", number_text(shines(light) ? level : 0.0));
  return plugin;
}

}  // namespace angen::desc
