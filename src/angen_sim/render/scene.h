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

/// Images of cameras: color under the lamps' light, and depth.
namespace angen::render {

using BodyId = Id<struct BodyTag>;

struct Surface {
  Shape shape;
  Pose pose;                                           // in its body's frame
  Eigen::Vector3f color{0.7F, 0.7F, 0.7F};             // diffuse albedo, r g b, 0..1
  Eigen::Vector3f emissive = Eigen::Vector3f::Zero();  // 1: the middle of the displayed range
  std::shared_ptr<const MeshLook> look{};              // look of a mesh's parts, instead of `color`
  // One for each part of the look, or one for the whole surface; they replace colors.
  std::vector<std::shared_ptr<const Texture>> textures{};
};

struct Body {
  std::vector<Surface> surfaces;
  Pose pose;  // world
  bool moves = false;
  bool holds_lamp = false;  // throws no shadows, and light shines through it
};

/// Light in addition to that of the lamps.
struct Ambience {
  Eigen::Vector3f ambient{0.4F, 0.4F, 0.4F};     // r g b, 0..1, as SDF's <scene> gives it
  Eigen::Vector3f background{0.7F, 0.7F, 0.7F};  // without a hit, as displayed
  std::shared_ptr<const light::ReflectedLight>
      reflected{};  // light of the lamps; null if not known
};

/// Bodies and their images. Adding and moving cost little; the next image builds the hierarchies.
/// One thread at a time calls it; it renders on `threads` threads, with 0 on one for each
/// processor. Same scene, same lamps, same pose: same bits, on however many threads.
class Scene {
 public:
  explicit Scene(int threads = 0);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  BodyId add(Body body);
  void move(BodyId body, const Pose& pose);
  void remove(BodyId body);

  /// height x width x 3 values, sRGB, row after row from the top. A surface of albedo a under E lx
  /// has the luminance L = a E / pi; it is shown as L / (L + 10 cd/m^2), sRGB-encoded. E is the
  /// lamps' direct light with hard shadows, plus reflected light where known, plus 2.5 lx times the
  /// ambient color.
  std::vector<std::uint8_t> colors(const PinholeCamera& camera, const Pose& pose,
                                   const std::vector<light::Lit>& lamps,
                                   const Ambience& ambience) const;

  /// height x width distances along the camera's axis in m; NaN without a surface between near and
  /// far. Color and depth skip surfaces within 0.5 m that a ray hits from behind, such as the
  /// camera's own housing.
  std::vector<float> depths(const PinholeCamera& camera, const Pose& pose) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace angen::render
