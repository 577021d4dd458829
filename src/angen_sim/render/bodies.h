#pragma once

#include <memory>
#include <vector>

#include "core/texture.h"
#include "rays/device.h"
#include "rays/triangle_tree.h"
#include "render/box_tree.h"
#include "render/hull.h"
#include "render/scene.h"

namespace angen::render {

/// Normal and finish of a triangle, in the frame of its patch.
struct Facet {
  Eigen::Vector3f normal;
  std::uint32_t finish = 0;
  std::uint32_t corners = 0;  // index of its texture coordinates, if its finish has a texture
};

struct Finish {
  Eigen::Vector3f color;
  Eigen::Vector3f emissive;
  std::shared_ptr<const Texture> texture{};  // instead of the color
};

/// A heightmap in the frame of its patch.
struct PlacedHeightmap {
  std::shared_ptr<const rays::TriangleTree> tree;
  Eigen::Matrix3d rotation;
  Vec3 position;
  std::uint32_t finish = 0;
};

/// Some faces that are in the way.
struct Faces {
  std::array<Face, 24> all;
  std::size_t count = 0;
};

/// Triangles and heightmaps that move as one, with a hierarchy of their own.
class Patch {
 public:
  /// Bodies with their poses in the patch's frame.
  explicit Patch(const std::vector<std::pair<const Body*, Pose>>& bodies);

  /// The facet that a ray has hit: geometry 0 has the triangles, each further one is a heightmap.
  Facet facet(std::uint32_t geometry, std::uint32_t triangle) const;
  const Finish& finish(const Facet& facet) const { return finishes_[facet.finish]; }
  /// The color at Embree's coordinates u v of a triangle.
  Eigen::Vector3f color(const Facet& facet, float u, float v) const;
  /// A triangle, with the one beside it if both are a quad.
  const Face& face(std::uint32_t triangle) const { return faces_[face_of_[triangle]]; }
  /// Calls visit(first triangle, face) for the faces in the hull, perhaps some beside it, until it
  /// returns false; false then, and if a heightmap is in the hull.
  template <class Visit>
  bool each_in(const Hull& hull, const Visit& visit) const {
    return !boxes_.any([&](const Boxes4& boxes) { return hull.overlaps(boxes); },
                       [&](std::uint32_t i) {
                         return i >= faces_.size() || !visit(first_triangles_[i], faces_[i]);
                       });
  }
  /// Adds the faces in the hull, perhaps some beside it; false if they are too many, or include a
  /// heightmap.
  bool find_in(const Hull& hull, Faces& faces) const;
  bool has_texture(std::uint32_t triangle) const {
    return finishes_[facets_[triangle].finish].texture != nullptr;
  }
  bool is_empty() const { return triangles_.empty() && heightmaps_.empty(); }
  const Box& bounds() const { return boxes_.bounds(); }  // not of an empty one
  RTCScene scene() const { return scene_.get(); }

 private:
  bool is_quad(std::size_t triangle) const;
  void append(const Surface& surface, const Pose& pose);
  void append_part(const Surface& surface, const TriangleMesh& mesh, std::size_t part);
  void append_heightmap(const Surface& surface, const Pose& at);
  void attach_triangles();
  void attach_heightmaps();
  void build_faces();

  std::vector<Eigen::Vector3f> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Facet> facets_;
  std::vector<PlacedHeightmap> heightmaps_;
  std::vector<Finish> finishes_;
  std::vector<std::array<float, 6>> corners_;  // u v of the corners of triangles with textures
  rays::Embree<RTCScene> scene_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> first_triangles_;  // by face
  std::vector<std::uint32_t> face_of_;          // by triangle
  BoxTree boxes_;                               // boxes of the faces, then of the heightmaps
};

}  // namespace angen::render
