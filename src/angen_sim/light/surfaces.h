#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rays/nearby.h"
#include "rays/scene.h"

namespace angen::light {

constexpr std::uint32_t kNoPatch = UINT32_MAX;
constexpr double kFacing = 0.4;  // m: a shape this close in front of a surface divides its cells

/// Static and anchored shapes: light is balanced between them.
constexpr rays::Mobilities kStanding =
    rays::only(rays::Mobility::kStatic) | rays::only(rays::Mobility::kAnchored);

/// A point of a patch that no shape covers; m, world.
struct Site {
  Vec3 position;
  Vec3 normal;
};

/// A piece of one side of a shape's surface of about 0.4 m (0.1 m if a shape covers a part of it or
/// is close in front of it, if an anchored one crosses it, and on open leaves), with one
/// illuminance. A shape that crosses such a part, as a leaf on a door's sill, separates it into
/// sides.
struct Patch {
  std::array<std::int32_t, 6> key;  // shape, face, depth, u, v; 0, 1 for a part, 2, 3, … for a side
  std::uint64_t hash = 0;
  std::vector<Site> sites;
  double area = 0.0;         // m^2, of the surface that the sites stand for
  std::uint64_t serial = 0;  // unique over all patches ever made in this process

  bool is_part() const { return key[5] != 0; }  // part of a divided cell
};

/// Patches, made when they are first hit. A patch depends on the shapes only, not on the ray that
/// hit it first. Copies share the patches.
class Surfaces {
 public:
  explicit Surfaces(std::shared_ptr<const rays::Scene> scene) : scene_(std::move(scene)) {}

  const rays::Scene& scene() const { return *scene_; }
  /// To be followed by forget() and forget_near() for all that differs.
  void set_scene(std::shared_ptr<const rays::Scene> scene) { scene_ = std::move(scene); }

  /// The patch at a hit on a standing shape, or kNoPatch for a sliver that has none, and for a
  /// shape that the scene does not contain.
  std::uint32_t at(std::uint32_t shape, const Vec3& point, const Vec3& normal);

  const Patch& operator[](std::uint32_t patch) const { return *patches_[patch]; }
  /// Whether the patch was not forgotten.
  bool alive(std::uint32_t patch) const { return patch < patches_.size() && patches_[patch]; }
  std::size_t size() const { return patches_.size(); }  // count of numbers given, removed or not

  std::uint64_t forgotten() const { return forgotten_; }  // patches, so far

  /// Forgets the patches of one shape, or those of it that may intersect a box (m, world): `around`
  /// is extended by their cells (m, world). Appends their numbers to `removed`; they are given to
  /// new patches after release().
  void forget(std::uint32_t shape, std::vector<std::uint32_t>& removed);
  void forget_near(std::uint32_t shape, const Eigen::AlignedBox3d& box,
                   std::vector<std::uint32_t>& removed, Eigen::AlignedBox3d& around);
  /// Calls visit() for each shape that has patches.
  template <class F>
  void each_known(F&& visit) const {
    for (std::uint32_t shape = 0; shape < shapes_.size(); ++shape) {
      if (shapes_[shape].form) visit(shape);
    }
  }
  /// Frees the numbers of forgotten patches.
  void release(const std::vector<std::uint32_t>& removed);

 private:
  using Key = std::array<std::int32_t, 6>;
  struct Lattice {  // lattice of one face of a shape
    rays::Placement placement;
    int axis = 0;
    double sign = 1.0;
    Eigen::Array2d low, step;  // m, of cells
    Eigen::Array2d parts;      // number along the sides of a divided cell
    // Of its cells in the list of the shape: the first, and their numbers, with one more on each
    // side. None of an endless or very large face.
    std::size_t first = 0;
    std::int32_t columns = 0, rows = 0, layers = 0;
  };
  struct Form {
    rays::Placement placement;
    Eigen::Matrix3d back;  // world to own frame
    std::array<Lattice, 6> faces;
    std::size_t cells = 0;
  };
  /// What is known of a shape. A number is that of a patch, kNoPatch, kUnknown, or that of a block
  /// from kBlock on: a divided cell has one of its parts, a part with sides one of these.
  struct Own {
    std::shared_ptr<const Form> form;
    std::vector<std::uint32_t> cells;
    std::unordered_map<std::uint64_t, std::uint32_t> far;  // looked up: places in `cells`
    std::vector<Key> far_keys;  // keys of the cells after those of the faces
    std::vector<std::vector<std::uint32_t>> blocks;
    std::vector<std::uint32_t> free_blocks;
  };

  struct Sides {
    std::vector<std::vector<Site>> groups;
    bool crossed = false;  // an anchored shape hides two neighboring sites from each other
  };

  Own* own_of(std::uint32_t shape);
  std::shared_ptr<const Form> form_of(std::uint32_t shape) const;
  const Lattice& lattice(const Key& key) const;
  static std::size_t cell_of(Own& own, const Key& key);
  static Eigen::AlignedBox3d cell_box(const Form& form, const Lattice& cells, int layer, int u,
                                      int v);
  static std::uint32_t add_block(Own& own, std::vector<std::uint32_t> numbers);
  Eigen::Array2d step_of(const Key& key) const;
  double area_of(const Key& key, const std::vector<Site>& sites) const;
  std::uint32_t make_cell(Own& own, const Key& key);
  std::uint32_t make_part(Own& own, const Key& key);
  std::uint32_t add(const Key& key, std::vector<Site> sites);
  std::uint32_t side_at(const std::vector<std::uint32_t>& all, const Site& point) const;
  rays::Nearby around(const Key& key) const;
  std::vector<Site> sites(const Key& key, int per_side, const rays::Nearby& near,
                          int& covered) const;
  bool site(const Lattice& lattice, const Key& key, double u, double v, Site& out) const;
  Sides sides(const Key& key, const std::vector<Site>& sites, const rays::Nearby& near) const;
  bool is_uneven(const Key& key, const std::vector<Site>& sites, const rays::Nearby& near) const;
  bool is_open_leaf(std::uint32_t shape) const;
  bool faced(const std::vector<Site>& sites) const;
  void forget_number(Own& own, std::uint32_t& number, std::vector<std::uint32_t>& removed);

  std::shared_ptr<const rays::Scene> scene_;
  std::vector<Own> shapes_;                            // by shape
  std::vector<std::shared_ptr<const Patch>> patches_;  // null if forgotten
  std::vector<std::uint32_t> free_;
  std::uint64_t forgotten_ = 0;
};

}  // namespace angen::light
