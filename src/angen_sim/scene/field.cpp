#include "scene/field.h"

#include <cmath>
#include <limits>

#include "core/text.h"

namespace angen::scene {

std::optional<Field> field_of(const sim::SensorEntry& sensor) {
  if (sensor.rays != nullptr) {
    const RayGeometry& rays = *sensor.rays;
    return Field{rays.min_yaw,   rays.max_yaw, rays.min_pitch,
                 rays.max_pitch, rays.max,     static_cast<std::uint32_t>(rays.size())};
  }
  const Element* camera = sensor.desc ? sensor.desc->element.child("camera") : nullptr;
  if (camera == nullptr || camera->child("horizontal_fov") == nullptr) return std::nullopt;
  const double half = parse_number(camera->child_text("horizontal_fov")).value_or(0.0) / 2;
  const Element* image = camera->child("image");
  const auto pixels = [&](const char* name, double usual) {
    return image == nullptr ? usual : parse_number(image->child_text(name)).value_or(usual);
  };
  const double high = std::atan(std::tan(half) * pixels("height", 240.0) / pixels("width", 320.0));
  return Field{-half, half, -high, high, std::numeric_limits<double>::infinity(), 0};
}

}  // namespace angen::scene
