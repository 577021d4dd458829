#include "load/light.h"

#include "load/material.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

desc::Light light_of(const Element& element, const Pose& pose) {
  desc::Light light;
  light.name = name_of(element);
  light.pose = pose;
  light.source = element.source;
  const std::string* type = element.attribute("type");
  if (type != nullptr && *type == "spot") light.type = desc::Light::Type::kSpot;
  if (type != nullptr && *type == "directional") light.type = desc::Light::Type::kDirectional;
  if (const Element* diffuse = element.child("diffuse")) {
    light.diffuse = color_of(*diffuse).head<3>();
  }
  light.intensity = child_number(element, "intensity", light.intensity);
  light.cast_shadows = child_flag(element, "cast_shadows", light.cast_shadows);
  if (const Element* attenuation = element.child("attenuation")) {
    light.range = child_number(*attenuation, "range", light.range);
  }
  if (const Element* direction = element.child("direction")) {
    const std::vector<double> v = numbers_of(*direction, 3);
    const Vec3 given(v[0], v[1], v[2]);
    if (given.norm() < 1e-9) {
      throw Error(direction->source, "the <direction> of this light has length 0; give 0 0 -1");
    }
    light.direction = given.normalized();
  }
  if (const Element* spot = element.child("spot")) {
    light.inner_angle = child_number(*spot, "inner_angle", 0.0);
    light.outer_angle = child_number(*spot, "outer_angle", 0.0);
  }
  // Angen's own: SDF knows no lights with an area.
  if (const Element* size = element.child("angen:rectangle")) {
    const std::vector<double> v = numbers_of(*size, 2);
    light.type = desc::Light::Type::kRectangle;
    light.width = v[0];
    light.height = v[1];
  } else if (const Element* disc = element.child("angen:disc")) {
    light.type = desc::Light::Type::kDisc;
    light.radius = numbers_of(*disc, 1)[0];
  }
  return light;
}

}  // namespace angen::load
