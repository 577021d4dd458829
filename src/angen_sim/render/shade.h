#pragma once

#include <array>
#include <vector>

#include "light/reflected_light.h"
#include "render/bodies.h"
#include "render/tracer.h"

namespace angen::render {

constexpr float kLift = 1e-3F;  // m off the surface that a shadow ray starts

/// The hits of a tile's rays.
struct alignas(64) Tile {
  int valid[kLanes];  // -1 for a hit, as Embree requires
  Eigen::Vector3f point[kLanes];
  Eigen::Vector3f normal[kLanes];  // unit, towards the camera
  Eigen::Vector3f light[kLanes];   // lx, r g b
  bool through[kLanes];            // lit from both sides
  const Finish* finish[kLanes];
  Eigen::Vector3f color[kLanes];  // albedo
  bool in_image[kLanes];
  int column, row;  // of its first pixel
  Box seen;         // around the points; empty without hits
  Box lifted;       // around the starts of shadow rays
};

/// Where a shadow ray starts.
inline Eigen::Vector3f lifted(const Tile& tile, int i) {
  return tile.point[i] + kLift * tile.normal[i];
}

/// Adds the direct light of one lamp to each point; without a scene nothing is in its way.
void shine(const light::Lit& lit, RTCScene opaque, Tile& tile);

/// Reflected light on tiles. It varies over decimeters: near points that face the same way get the
/// same, as the last tile's do. Tiles of a strip come from left to right, so that images do not
/// depend on which thread has which strips.
class Reflections {
 public:
  Reflections(const light::ReflectedLight& light, RTCScene opaque);

  /// Begins a row of blocks.
  void start() { strips_ = {}; }
  /// Adds reflected light to each point.
  void shine(Tile& tile);

 private:
  struct Known {
    Eigen::Vector3f point, normal, light;
  };
  using Some = std::array<Known, kLanes>;

  static const Known* find(const Some& all, int count, const Eigen::Vector3f& point,
                           const Eigen::Vector3f& normal);

  light::ReflectedLookup lookup_;
  struct Strip {
    Some last;  // of the last tile
    int count = 0;
  };
  std::array<Strip, kTilesAcross> strips_;  // of the row of blocks
};

/// sRGB byte of a luminance in cd/m^2.
std::uint8_t shown(float luminance);

/// Byte of a color of 0..1 that is displayed unchanged.
std::uint8_t shown_as_is(float value);

constexpr float kMiddleLuminance = 10.0F;    // cd/m^2, shown as half of full light
constexpr float kAmbientIlluminance = 2.5F;  // lx

}  // namespace angen::render
