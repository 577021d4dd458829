#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/lists.h"
#include "core/polygon.h"
#include "document/values.h"
#include "sdf/geometry.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxCorners = 1000;  // corners of all outlines

Polygon outline_of(const Element& polyline) {
  Polygon outline;
  for (const Element& child : polyline.children) {
    if (child.name != "point") continue;
    const std::vector<double> v = numbers_of(child, 2);
    const Point2 corner(v[0], v[1]);
    if (outline.empty() || outline.back() != corner) outline.push_back(corner);
  }
  if (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
  if (outline.size() < 3) {
    throw Error(polyline.source, "<polyline> has " + std::to_string(outline.size()) +
                                     " corners; give it three <point>s or more");
  }
  if (const auto crossing = crossing_edges(outline)) {
    throw Error(polyline.source, "<polyline> crosses itself between the <point>s " +
                                     std::to_string((*crossing)[0] + 1) + " and " +
                                     std::to_string((*crossing)[1] + 1) + "; put them in order");
  }
  if (signed_area(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return outline;
}

struct Edge {
  Point2 low, high;  // by y

  double x_at(double y) const {
    return low.x() + (y - low.y()) / (high.y() - low.y()) * (high.x() - low.x());
  }
};

/// Makes the prism: an outline in another one is a hole in it, and so on.
class Prism {
 public:
  Prism(const std::vector<Polygon>& outlines, double height)
      : outlines_(outlines), height_(height) {}

  TriangleMesh made() {
    for (std::size_t i = 0; i < outlines_.size(); ++i) add_sides(i);
    add_caps();
    return std::move(mesh_);
  }

 private:
  std::uint32_t add(const Point2& at, double z) {
    mesh_.vertices.emplace_back(Vec3(at.x(), at.y(), z).cast<float>());
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  // Its corners counterclockwise as seen from outside.
  void add_quad(const std::array<std::uint32_t, 4>& q) {
    mesh_.triangles.push_back({q[0], q[1], q[2]});
    mesh_.triangles.push_back({q[0], q[2], q[3]});
  }

  void add_sides(std::size_t number) {
    const Polygon& outline = outlines_[number];
    bool hole = false;
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
      if (i != number && contains(outlines_[i], outline[0])) hole = !hole;
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
      Point2 from = outline[i];
      Point2 to = outline[(i + 1) % outline.size()];
      if (hole) std::swap(from, to);
      add_quad({add(from, 0.0), add(to, 0.0), add(to, height_), add(from, height_)});
      const bool level = from.y() == to.y();
      if (!level) edges_.push_back(from.y() < to.y() ? Edge{from, to} : Edge{to, from});
    }
  }

  // Cut into strips at all corners: in each every second gap between edges is inside.
  void add_caps() {
    std::vector<double> cuts;
    for (const Edge& edge : edges_) cuts.insert(cuts.end(), {edge.low.y(), edge.high.y()});
    sort_unique(cuts);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) add_strip(cuts[i], cuts[i + 1]);
  }

  void add_strip(double low, double high) {
    std::vector<const Edge*> across;
    for (const Edge& edge : edges_) {
      if (edge.low.y() <= low && edge.high.y() >= high) across.push_back(&edge);
    }
    const double middle = (low + high) / 2.0;
    std::sort(across.begin(), across.end(),
              [&](const Edge* a, const Edge* b) { return a->x_at(middle) < b->x_at(middle); });
    for (std::size_t i = 0; i + 1 < across.size(); i += 2) {
      const std::array<Point2, 4> at = {
          Point2(across[i]->x_at(low), low), Point2(across[i + 1]->x_at(low), low),
          Point2(across[i + 1]->x_at(high), high), Point2(across[i]->x_at(high), high)};
      const auto corner = [&](int k, double z) { return add(at[static_cast<std::size_t>(k)], z); };
      add_quad({corner(0, height_), corner(1, height_), corner(2, height_), corner(3, height_)});
      add_quad({corner(0, 0.0), corner(3, 0.0), corner(2, 0.0), corner(1, 0.0)});
    }
  }

  const std::vector<Polygon>& outlines_;
  double height_;
  std::vector<Edge> edges_;
  TriangleMesh mesh_;
};

// A strip that begins or ends in a corner has triangles without area.
void remove_flat(TriangleMesh& mesh) {
  auto& all = mesh.triangles;
  erase_if(all, [&](const auto& t) {
    const Eigen::Vector3f& a = mesh.vertices[t[0]];
    const Eigen::Vector3f b = mesh.vertices[t[1]] - a;
    return b.cross(mesh.vertices[t[2]] - a).norm() < 1e-9F;
  });
}

}  // namespace

Shape polyline_prism(const Reader& geometry, Session& session) {
  std::vector<Polygon> outlines;
  std::size_t corners = 0;
  std::optional<double> height;
  geometry.note({"polyline"});
  for (const Element& child : geometry.element().children) {
    const Reader polyline(child, session);
    if (child.name != "polyline") {
      throw Error(child.source, "a second shape in one <geometry>; keep one");
    }
    polyline.note({"point"});
    const std::optional<double> given = polyline.number("height", Range::size());
    if (!height) height = given;
    outlines.push_back(outline_of(child));
    corners += outlines.back().size();
  }
  const Source& at = geometry.element().children[0].source;
  if (corners > kMaxCorners) {
    throw Error(at, "more than " + std::to_string(kMaxCorners) +
                        " <point>s in one <geometry>; give several links or fewer points");
  }
  TriangleMesh mesh = Prism(outlines, height.value_or(1.0)).made();
  remove_flat(mesh);
  Shape shape;
  shape.type = Shape::Type::kMesh;
  shape.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return shape;
}

}  // namespace angen::load
