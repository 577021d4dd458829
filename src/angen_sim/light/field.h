#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "light/lamp.h"
#include "light/reflected_light.h"
#include "light/surfaces.h"

namespace angen::light {

// SDF's white is 1, with which reflections would never end; white paint reflects at most this.
constexpr float kLargestAlbedo = 0.9F;

using Rgb = Eigen::Array4f;  // r g b and one unused, for SIMD

/// Light of one white lamp at level 1 on the patches that it reaches, directly or by reflections on
/// static and anchored surfaces.
struct Solution {
  std::vector<std::uint32_t> patches;  // patches that the light reaches
  std::vector<std::uint64_t> serials;
  std::uint32_t first_patch = 0;      // the lowest of `patches`
  std::vector<std::uint32_t> places;  // their indices, by patch - first_patch; or kNoPatch
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_hash;  // hash and index, ascending
  std::vector<float> direct;                                     // lx
  std::vector<Rgb> reflected;                                    // lx, from other patches
  Eigen::AlignedBox3d bounds;        // bounds of the patches and the lamp
  std::uint64_t stamp = 0;           // unique
  std::uint64_t serials_before = 0;  // patches with higher serials were made after this was begun
  bool outlined = false;             // has bounds only, of the directly lit surfaces
  // lx that patches outside of the solution receive from its patches, by hash; valid for one state.
  mutable std::unordered_map<std::uint64_t, Rgb> indirect_cache;
  mutable std::uint64_t indirect_state = 0;
};

/// A partly computed solution; see Field::advance.
struct Unfinished {
  explicit Unfinished(const Lamp& of) : lamp(of) {}

  std::uint32_t place_of(std::uint32_t patch) const {
    return patch < places.size() ? places[patch] : kNoPatch;
  }

  struct Sampling {        // how a patch samples what it sees
    float density = 0.0F;  // links per m^2
    float extent = 0.0F;   // m, root of its links times its area
    bool is_part = false;  // part of a divided cell
  };
  struct Arrival {  // a link to a patch that counts as one from it
    std::uint32_t from = 0;
    std::uint32_t before = kNoPatch;  // the arrival before this one at the same patch
  };

  Lamp lamp;
  Solution solution;
  Eigen::AlignedBox3d world;     // m, bounds of static shapes
  std::vector<rays::Ray> first;  // from the lamp, to find the lit patches
  std::size_t cast = 0;          // how many of `first` are cast
  std::size_t followed = 0;      // patches of the solution whose reflected light has been followed
  std::vector<std::uint32_t> places;  // by patch: its index, or kNoPatch
  std::vector<Rgb> leaving;           // lx that leave each patch
  std::vector<Sampling> samplings;    // by index, as what follows
  std::vector<Rgb> albedos;
  std::vector<Arrival> arrivals;
  std::vector<std::uint32_t> last_arrivals;  // at each patch, or kNoPatch
  std::size_t arrived = 0;                   // patches whose links are among them
  std::vector<std::uint32_t> seen;           // the patches that each one sees
  std::vector<float> factors;                // by entry of `seen`: form factor
  std::vector<std::size_t> rows;             // begin of each patch's part of `seen`, and the end
  std::vector<std::size_t> entries;          // by patch: its entry in the last row that has it
  int bounces = 0;
  std::size_t balanced = 0;  // patches, in this bounce
  float change = 0.0F;       // lx, the largest in this bounce
  double total = 0.0;        // lx, sum over the patches balanced in this bounce
};

/// Diffuse light between the patches of a scene (radiosity). Rays find once which patches each one
/// sees, and again only where a standing shape was added, removed or moved.
class Field {
 public:
  explicit Field(const rays::Scene& scene) : scene_(scene), surfaces_(scene) {}

  struct Change {
    Eigen::AlignedBox3d box;  // m, world: around a shape's old and new place
    bool is_static = false;
  };
  /// Returns where standing shapes were added, removed or moved since the last call.
  std::vector<Change> follow();
  bool outdated() const { return !outdated_.empty(); }
  /// Whether the box (m, world) has a change that no update has begun to process.
  bool outdated_in(const Eigen::AlignedBox3d& box) const;
  std::uint64_t revision() const { return revision_; }  // grows when an update begins or ends
  std::uint64_t updates() const { return updates_; }    // completed ones
  /// Forgets the patches near the changes that follow() has found; they are made again when a ray
  /// hits them. Begins to update the links of other patches to them.
  void start_update();
  bool updating() const { return updating_; }
  /// Continues the update for a cost of about `rays` rays, at least one step; returns the cost.
  std::int64_t update(std::int64_t rays);

  std::uint32_t patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal);
  /// Makes the links of a patch and the patches at their ends. Returns the cost in rays, or 0 if it
  /// was counted before; links that a query has made still cost the same.
  std::int64_t cost_of(std::uint32_t patch);
  bool counted(std::uint32_t patch) const {
    return patch < patch_links_.size() && patch_links_[patch].counted;
  }
  std::uint64_t serial(std::uint32_t patch) const { return surfaces_[patch].serial; }
  bool alive(std::uint32_t patch) const { return surfaces_[patch].alive; }
  std::uint64_t forgotten() const { return surfaces_.forgotten(); }  // patches since the start
  Rgb albedo(std::uint32_t shape) const;
  Rgb albedo_of(std::uint32_t patch) const;

  /// Continues a solution for a cost of about `rays` rays, at least one step, and subtracts the
  /// cost. Returns whether it is complete; it is then the same, however it was divided, if nothing
  /// has changed meanwhile.
  bool advance(Unfinished& work, std::int64_t& rays);
  /// Finds the bounds of the directly lit surfaces, and subtracts the cost from `rays`.
  Solution outline(const Lamp& lamp, std::int64_t& rays) const;

  /// Whether the solution contains the patch; true for kNoPatch. In a `stale` solution, a patch
  /// that was made again at the same place has the values of the old one.
  bool reaches(const Solution& solution, std::uint32_t patch, bool stale) const;

  /// lx on a patch directly from the lamp; 0 if the solution does not contain the patch.
  float direct(const Solution& solution, std::uint32_t patch, bool stale) const;

  /// lx on a patch from other patches, also if the solution does not contain the patch; but 0 then
  /// if the solution is `stale` and the patch is not counted.
  Rgb reflected(const Solution& solution, std::uint32_t patch, bool stale);

  /// Adds the solution's reflected lx times `factor` to `light`, by patch.
  void add_reflected(const Solution& solution, const Rgb& factor, std::vector<Rgb>& light) const;
  /// The patches whose `light` (lx) is more than 0.
  std::vector<ReflectedLight::Piece> pieces(const std::vector<Rgb>& light) const;

 private:
  struct Link {
    std::uint32_t patch = kNoPatch;
    float range = 0.0F;  // m, to the hit
  };
  struct PatchLinks {  // the patches that one patch sees
    PatchLinks() = default;
    // noexcept, so that a growing vector moves it: the move of Eigen's box is not declared so.
    PatchLinks(PatchLinks&&) noexcept = default;
    PatchLinks& operator=(PatchLinks&&) noexcept = default;

    std::vector<Link> links;
    Eigen::AlignedBox3d reach;
    bool counted = false;     // see cost_of()
    bool made = false;        // making its patch has been counted
    std::int64_t price = 0;   // price of a ray from it in ordinary rays; 0 until it is queried
    std::uint64_t scene = 0;  // the scene's revision in which they were found
  };
  using Box = Eigen::AlignedBox3d;
  using Known = std::optional<rays::Standing>;

  void compare(std::uint32_t shape, const Known& now, bool is_static, std::vector<Change>& changes);
  void note(std::uint32_t shape, const Box& box, bool is_static, std::vector<Change>& changes);
  void forget_near(const Box& box);
  void drop_uncounted();
  bool in_flux() const { return updating_ || !outdated_.empty(); }
  std::uint32_t place(const Solution& solution, std::uint32_t patch, bool stale) const;
  Rgb cached_indirect(const Solution& solution, std::uint32_t patch, bool stale);
  std::int64_t cost_of_making(std::uint32_t patch);
  std::int64_t price_of(std::uint32_t patch);
  const std::vector<Link>& links(std::uint32_t patch);
  Link link_of(const rays::Ray& ray, const rays::Hit& hit);
  std::int64_t update_links(std::uint32_t patch);
  std::int64_t start(Unfinished& work, std::int64_t rays);
  std::int64_t spread(Unfinished& work, std::int64_t rays);
  void follow_patch(Unfinished& work);
  std::int64_t list_samplings(Unfinished& work, std::int64_t rays);
  std::int64_t list_arrivals(Unfinished& work, std::int64_t rays);
  std::int64_t list_exchanges(Unfinished& work, std::int64_t rays);
  std::int64_t balance(Unfinished& work, std::int64_t rays);
  void finish(Unfinished& work);
  float direct(const Lamp& lamp, std::uint32_t patch) const;

  const rays::Scene& scene_;
  Surfaces surfaces_;
  std::vector<PatchLinks> patch_links_;  // by patch; empty until it is queried
  std::vector<Known> known_;             // by shape, as of the last follow()
  std::uint64_t followed_ = 0;           // the scene's mark of changes then
  std::uint64_t revision_ = 0;
  std::uint64_t updates_ = 0;
  std::vector<std::uint32_t> outdated_;  // shapes that have changed since the last update began
  std::vector<Box> been_;                // by shape: old and new boxes of those of `outdated_`
  bool updating_ = false;
  std::vector<Box> boxes_;                // changes that the current update processes
  std::vector<std::uint32_t> releasing_;  // patch numbers to free after the update
  std::size_t updated_ = 0;               // how many of `counted_` are updated
  std::vector<std::uint32_t> counted_;    // patches, in the order of counting
  std::vector<std::uint32_t> uncounted_;  // patches whose links only queries have used
};

}  // namespace angen::light
