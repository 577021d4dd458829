#pragma once

#include <cmath>
#include <vector>

#include "angen_sim/rays/shapes.h"
#include "render/scene.h"

/// A scene with one camera, and the bodies and lamps of tests.
namespace angen::render {

using rays::testing::box;
using rays::testing::round;

inline Pose at(double x, double y = 0.0, double z = 0.0) { return {{x, y, z}, Quat::Identity()}; }

inline Body body(const Shape& shape, const Pose& pose,
                 const Eigen::Vector3f& color = {0.5F, 0.5F, 0.5F}) {
  Body made;
  made.surfaces.push_back({shape, Pose{}, color, Eigen::Vector3f::Zero()});
  made.pose = pose;
  return made;
}

inline light::Lit lamp(const Vec3& position, double lumen) {
  light::Lit lit;
  lit.lamp.pose.position = position;
  lit.lamp.luminous_flux = lumen;
  lit.level = 1.0;
  return lit;
}

inline const Ambience kDark{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
inline const Ambience kDim{Eigen::Vector3f::Ones(), Eigen::Vector3f::Zero()};

/// The byte of a surface of albedo `albedo` under `lux`, by the header's formula.
inline int expected_byte(double albedo, double lux) {
  const double luminance = albedo * lux / M_PI;
  const double v = luminance / (luminance + 10.0);
  return static_cast<int>(
      std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

struct View {
  PinholeCamera pinhole;
  Scene scene;
  Pose camera;

  float depth(int column, int row) const {
    return scene.depths(pinhole, camera)[static_cast<std::size_t>(row * pinhole.width + column)];
  }
  Eigen::Vector3i color(int column, int row, const std::vector<light::Lit>& lamps,
                        const Ambience& ambience = kDark) const {
    const std::vector<std::uint8_t> all = scene.colors(pinhole, camera, lamps, ambience);
    const std::size_t first = 3 * static_cast<std::size_t>(row * pinhole.width + column);
    return {all[first], all[first + 1], all[first + 2]};
  }
};

}  // namespace angen::render
