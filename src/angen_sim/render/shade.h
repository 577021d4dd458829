#pragma once

#include <vector>

#include "light/reflected_light.h"
#include "render/bodies.h"

namespace angen::render {

/// Sixteen pixels at once: a tile of 4 x 4.
constexpr int kTile = 4;
constexpr int kLanes = kTile * kTile;

/// What the rays of a tile met.
struct alignas(64) Tile {
  int valid[kLanes];  // -1 where something was met, as Embree wants it
  Eigen::Vector3f point[kLanes];
  Eigen::Vector3f normal[kLanes];  // unit, towards the camera
  Eigen::Vector3f light[kLanes];   // lx, r g b
  bool through[kLanes];            // lit from both sides
  const Finish* finish[kLanes];
  Eigen::Vector3f color[kLanes];  // albedo
};

/// Adds what one lamp sends to each point.
void shine(const light::Lit& lit, RTCScene opaque, Tile& tile);

/// Adds what surfaces reflect to each point.
void shine(light::ReflectedLookup& reflected, Tile& tile);
/// Which points can be seen from another; see light::ReflectedLookup.
std::uint32_t seen_from(const Eigen::Vector3f& from, const Eigen::Vector3f* to, int count,
                        RTCScene opaque);

/// sRGB bytes of a luminance in cd/m^2.
std::uint8_t shown(float luminance);

/// A color of 0..1 that is to be displayed as it is.
std::uint8_t shown_as_is(float value);

constexpr float kMiddleLuminance = 10.0F;    // cd/m^2, shown as half of full light
constexpr float kAmbientIlluminance = 2.5F;  // lx

}  // namespace angen::render
