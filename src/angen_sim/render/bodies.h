#pragma once

#include <memory>
#include <vector>

#include "core/mesh_look.h"
#include "core/texture.h"
#include "rays/device.h"
#include "rays/height_tree.h"
#include "render/scene.h"

namespace angen::render {

/// A triangle's finish, in the frame of the patch that it belongs to.
struct Facet {
  Eigen::Vector3f normal;
  std::uint32_t finish = 0;
  std::uint32_t corners = 0;  // where its picture lies, of one with a texture
};

struct Finish {
  Eigen::Vector3f color;
  Eigen::Vector3f emissive;
  std::shared_ptr<const Texture> texture{};  // in place of the color
};

/// A heightmap in its patch.
struct PlacedHeightmap {
  std::shared_ptr<const rays::HeightTree> tree;
  Eigen::Matrix3d rotation;
  Vec3 position;
  std::uint32_t finish = 0;
};

/// Triangles and heightmaps that move as one, with a hierarchy of their own.
class Patch {
 public:
  /// Bodies with their poses in the patch's frame.
  explicit Patch(const std::vector<std::pair<const Body*, Pose>>& bodies);

  /// Of what a ray met: geometry 0 holds the triangles, each further one is a heightmap.
  Facet facet(std::uint32_t geometry, std::uint32_t triangle) const;
  const Finish& finish(const Facet& facet) const { return finishes_[facet.finish]; }
  /// The color at u v of the triangle, as Embree counts them.
  Eigen::Vector3f color(const Facet& facet, float u, float v) const;
  RTCScene scene() const { return scene_.get(); }

 private:
  void append(const Surface& surface, const Pose& pose);
  void append_part(const Surface& surface, const TriangleMesh& mesh, std::size_t part);
  void append_heightmap(const Surface& surface, const Pose& at);
  void attach_triangles();
  void attach_heightmaps();

  std::vector<Eigen::Vector3f> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Facet> facets_;
  std::vector<PlacedHeightmap> heightmaps_;
  std::vector<Finish> finishes_;
  std::vector<std::array<float, 6>> corners_;  // u v of those of triangles with textures
  rays::Embree<RTCScene> scene_;
};

/// A patch where it stands.
struct Placed {
  std::unique_ptr<Patch> patch;
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  bool shines_through = false;
  rays::Embree<RTCGeometry> instance;
};

/// Every patch, in two hierarchies: all that is seen, and all that throws shadows.
class Stand {
 public:
  Stand();

  /// Puts a patch in; its number is the instance's in both hierarchies.
  std::uint32_t add(std::unique_ptr<Patch> patch, const Pose& pose, bool throws_shadows);
  void place(std::uint32_t number, const Pose& pose);
  void clear();
  void commit();

  const Placed& operator[](std::uint32_t number) const { return placed_[number]; }
  RTCScene seen() const { return seen_.get(); }
  RTCScene opaque() const { return opaque_.get(); }

 private:
  std::vector<Placed> placed_;
  rays::Embree<RTCScene> seen_;
  rays::Embree<RTCScene> opaque_;
};

}  // namespace angen::render
