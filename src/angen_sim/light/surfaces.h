#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

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
  std::uint64_t serial = 0;  // unique over all patches ever made
  bool alive = true;         // not forgotten since

  bool is_part() const { return key[5] != 0; }  // part of a divided cell
};

/// Patches, made when they are first hit. A patch depends on the shapes only, not on the ray that
/// hit it first.
class Surfaces {
 public:
  explicit Surfaces(const rays::Scene& scene) : scene_(scene) {}

  /// The patch at a hit on a static or anchored shape, or kNoPatch for a sliver that has none.
  std::uint32_t at(std::uint32_t shape, const Vec3& point, const Vec3& normal);

  const Patch& operator[](std::uint32_t patch) const { return patches_[patch]; }
  std::uint64_t serials() const { return serials_; }    // last number given, from 1 on
  std::size_t size() const { return patches_.size(); }  // count of numbers given, removed or not

  std::uint64_t forgotten() const { return forgotten_; }  // patches, so far

  /// Forgets the patches of one shape, or those of it that may intersect a box (m, world). Appends
  /// their numbers to `removed`; they can be read until release().
  void forget(std::uint32_t shape, std::vector<std::uint32_t>& removed);
  void forget_near(std::uint32_t shape, const Eigen::AlignedBox3d& box,
                   std::vector<std::uint32_t>& removed);
  /// Frees the numbers of forgotten patches.
  void release(const std::vector<std::uint32_t>& removed);

 private:
  using Key = std::array<std::int32_t, 6>;
  struct HashKey {
    std::size_t operator()(const Key& key) const;
  };
  struct Lattice {  // lattice of one face of a shape
    rays::Placement placement;
    int axis = 0;
    double sign = 1.0;
    Eigen::Array2d low, step;  // m, of cells
    Eigen::Array2d parts;      // number along the sides of a divided cell
  };

  struct Sides {
    std::vector<std::vector<Site>> groups;
    bool crossed = false;  // an anchored shape hides two neighboring sites from each other
  };

  Lattice lattice(std::uint32_t shape, int face) const;
  Eigen::Array2d step_of(const Key& key) const;
  double area_of(const Key& key, const std::vector<Site>& sites) const;
  std::uint32_t make(const Key& key);
  std::uint32_t add(const Key& key, std::vector<Site> sites, bool divided);
  bool make_sides(const Key& key);
  std::uint32_t side_at(const Key& key, const Site& point) const;
  std::vector<Site> sites(const Key& key, int per_side, int& covered) const;
  bool site(const Lattice& lattice, const Key& key, double u, double v, Site& out) const;
  Sides sides(const Key& key, const std::vector<Site>& sites) const;
  bool is_uneven(const Key& key, const std::vector<Site>& sites) const;
  bool hidden(const Site& from, const Site& to, rays::Mobilities by = kStanding) const;
  bool is_open_leaf(std::uint32_t shape) const;
  bool faced(const std::vector<Site>& sites) const;
  template <class Matches>
  void forget_if(std::uint32_t shape, std::vector<std::uint32_t>& removed, Matches&& matches);

  const rays::Scene& scene_;
  std::unordered_map<Key, std::uint32_t, HashKey> known_;     // looked up, never iterated
  std::unordered_map<std::uint32_t, std::vector<Key>> keys_;  // by shape
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> free_;
  std::uint64_t serials_ = 0;
  std::uint64_t forgotten_ = 0;
};

}  // namespace angen::light
