#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/id.h"
#include "core/shape.h"
#include "light/lamp.h"
#include "render/pinhole_camera.h"

namespace angen::light {

class ReflectedLight;

}  // namespace angen::light

namespace angen {

struct MeshLook;
struct Texture;

}  // namespace angen

/// What cameras see: color under the lamps' light, and depth.
namespace angen::render {

using BodyId = Id<struct BodyTag>;

struct Surface {
  Shape shape;
  Pose pose;                                           // in its body's frame
  Eigen::Vector3f color{0.7F, 0.7F, 0.7F};             // diffuse albedo, r g b, 0..1
  Eigen::Vector3f emissive = Eigen::Vector3f::Zero();  // 1: as bright as the middle of the range
  std::shared_ptr<const MeshLook> look{};              // of a mesh's parts, in place of `color`
  // Of the look's parts, or the one of the whole surface; they replace colors.
  std::vector<std::shared_ptr<const Texture>> textures{};
};

struct Body {
  std::vector<Surface> surfaces;
  Pose pose;  // world
  bool moves = false;
  bool holds_lamp = false;  // it throws no shadows, and light shines through it
};

/// What light there is besides the lamps'.
struct Ambience {
  Eigen::Vector3f ambient{0.4F, 0.4F, 0.4F};     // r g b, 0..1, as SDF's <scene> gives it
  Eigen::Vector3f background{0.7F, 0.7F, 0.7F};  // where nothing is, as displayed
  std::shared_ptr<const light::ReflectedLight> reflected{};  // of the lamps; null: not known
};

/// Adding and moving cost next to nothing; hierarchies are built when the first picture is drawn.
/// One thread at a time. Same scene, same lamps, same pose: same bits.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  BodyId add(Body body);
  void move(BodyId body, const Pose& pose);
  void remove(BodyId body);

  /// height x width x 3 values, sRGB, row after row from the top. A surface of albedo a under
  /// E lx has the luminance L = a E / pi; it is shown as L / (L + 10 cd/m^2), sRGB-encoded. E is
  /// the lamps' direct light with hard shadows, what surfaces reflect of it where that is known,
  /// and 2.5 lx times the ambient color.
  std::vector<std::uint8_t> colors(const PinholeCamera& camera, const Pose& pose,
                                   const std::vector<light::Lit>& lamps,
                                   const Ambience& ambience) const;

  /// height x width distances along the camera's axis in m; NaN where nothing is between near and
  /// far. Neither sees what a ray meets from behind within 0.5 m: a camera's own housing.
  std::vector<float> depths(const PinholeCamera& camera, const Pose& pose) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::render
