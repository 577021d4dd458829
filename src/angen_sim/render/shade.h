#pragma once

#include <array>

#include "light/lamp.h"
#include "render/instances.h"
#include "render/tracer.h"

namespace angen::render {

constexpr float kLift = 1e-3F;  // m off the surface that a shadow ray starts

/// A number for each pixel of a tile.
using Lanes = Eigen::Array<float, kLanes, 1>;

/// A vector for each pixel, in columns. Sums of three products are a + (b + c), as Eigen's are.
struct Columns {
  Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero();

  Eigen::Vector3f operator[](int i) const { return {x[i], y[i], z[i]}; }
  void set(int i, const Eigen::Vector3f& to) {
    x[i] = to.x();
    y[i] = to.y();
    z[i] = to.z();
  }
  void set_all(const Eigen::Vector3f& to) {
    x = to.x();
    y = to.y();
    z = to.z();
  }
  Lanes dot(const Columns& other) const { return x * other.x + (y * other.y + z * other.z); }
};

/// The hits of a tile's rays.
struct alignas(64) Tile {
  int valid[kLanes];  // -1 for a hit, as Embree requires
  Columns point;
  Columns normal;        // unit, towards the camera
  Columns lifted;        // where shadow rays start
  Lanes depth;           // m
  Columns light;         // lx, r g b
  bool through[kLanes];  // lit from both sides
  const Finish* finish[kLanes];
  Columns color;  // albedo
  bool in_image[kLanes];
  bool is_even;     // all pixels show the same facet, from the same side
  int column, row;  // place of its first pixel
  Box seen;         // around the points; empty without hits
  Box starts;       // around the lifted points
};

/// Sets rays from points along the ways from there.
void set_segments(const Columns& from, const Columns& way, RTCRay16& rays);

/// Sets `seen`, which has a number for each point, to 0 if one of the faces is between the point
/// and that place.
void drop_hidden(const Faces& faces, const Eigen::Vector3f& from, const Columns& points, int* seen);

/// Adds the direct light of one lamp to each point. `obstacles`: what may hide the lamp; null if
/// nothing does.
void shine(const light::Lit& lit, const Instances& instances, const Obstacles* obstacles,
           Tile& tile);

/// sRGB bytes of luminances in cd/m^2.
std::array<std::uint8_t, kLanes> shown(const Lanes& luminances);

/// Byte of a color of 0..1 that is displayed unchanged.
std::uint8_t shown_as_is(float value);

constexpr float kMiddleLuminance = 10.0F;    // cd/m^2, shown as half of full light
constexpr float kAmbientIlluminance = 2.5F;  // lx

}  // namespace angen::render
