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

// SDF's white is 1, which would let light live for ever; white paint reflects no more than this.
constexpr float kLargestAlbedo = 0.9F;

using Rgb = Eigen::Array4f;  // r g b and one unused, as vector units like it

/// What one lamp at level 1 and of white light gives every patch that its light comes to, by way of
/// static and anchored surfaces.
struct Solution {
  std::vector<std::uint32_t> patches;  // its light comes to these
  std::vector<std::uint64_t> serials;
  std::uint32_t first_patch = 0;      // the lowest number of these
  std::vector<std::uint32_t> places;  // in the other lists, by number from that on; or kNoPatch
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_hash;  // the same, ascending
  std::vector<float> direct;                                     // lx
  std::vector<Rgb> reflected;                                    // lx, from other patches
  Eigen::AlignedBox3d bounds;                                    // of the patches and the lamp
  std::uint64_t stamp = 0;                                       // no two are alike
  std::uint64_t serials_before = 0;  // patches of higher ones were made after it was begun
  bool outlined = false;             // no more than the bounds, of what the lamp itself shines on
  // Light that other patches reflect, once queried: lx, by hash, and the state that it holds for.
  mutable std::unordered_map<std::uint64_t, Rgb> indirect_cache;
  mutable std::uint64_t indirect_state = 0;
};

/// A partly computed solution; see Field::advance.
struct Unfinished {
  explicit Unfinished(const Lamp& of) : lamp(of) {}

  Lamp lamp;
  Solution solution;
  Eigen::AlignedBox3d world;          // around what is static, m
  std::vector<rays::Ray> first;       // that find what the lamp shines on
  std::size_t cast = 0;               // of these
  std::size_t followed = 0;           // of the solution's patches: with what they throw back
  std::vector<std::uint32_t> places;  // by patch, in the solution's lists; kNoPatch for none
  std::vector<Rgb> leaving;           // lx, of those
  std::vector<std::uint32_t> seen;    // by patch, the places of those that it sees
  std::vector<std::size_t> rows;      // where each patch's begin, and the last one's end
  std::vector<Rgb> albedos;           // of those that are ready to be balanced
  int bounces = 0;
  std::size_t balanced = 0;  // patches, in this bounce
  float change = 0.0F;       // lx, the largest in it
  double total = 0.0;        // lx, on all patches after it
};

/// Diffuse light between the patches of a scene: what each sees is found by rays once, and anew
/// only where a standing shape has come, gone or moved.
class Field {
 public:
  explicit Field(const rays::Scene& scene) : scene_(scene), surfaces_(scene) {}

  struct Change {
    Eigen::AlignedBox3d box;  // m, world: where a shape was and is
    bool is_static = false;
  };
  /// Finds which standing shapes came, went or moved since the last call.
  std::vector<Change> follow();
  bool outdated() const { return !outdated_.empty(); }
  /// Whether a change that no update has begun with is in the box.
  bool outdated_in(const Eigen::AlignedBox3d& box) const;
  std::uint64_t revision() const { return revision_; }  // grows when an update begins or ends
  std::uint64_t updates() const { return updates_; }    // that have ended
  /// Forgets the patches where follow() has found changes up to now; they are made anew when they
  /// are met. Begins to find anew what others see there.
  void start_update();
  bool updating() const { return updating_; }
  /// Goes on with it for the cost of about `rays` rays, at least one step; returns the cost.
  std::int64_t update(std::int64_t rays);

  std::uint32_t patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal);
  /// Has links and patches that it needs made, and says what that costs in rays: nothing where a
  /// solution or another call has been counted for them, whichever query made them.
  std::int64_t cost_of(std::uint32_t patch);
  bool counted(std::uint32_t patch) const {
    return patch < patch_links_.size() && patch_links_[patch].counted;
  }
  std::uint64_t serial(std::uint32_t patch) const { return surfaces_[patch].serial; }
  bool alive(std::uint32_t patch) const { return surfaces_[patch].alive; }
  Rgb albedo(std::uint32_t shape) const;
  Rgb albedo_of(std::uint32_t patch) const;

  Solution solve(const Lamp& lamp);
  /// Goes on with a solution for the cost of about `rays` rays, at least one step, and takes the
  /// cost off. True when it is complete: the same as that of solve(), in however many parts, if
  /// nothing has changed since.
  bool advance(Unfinished& work, std::int64_t& rays);
  /// Finds where the lamp itself shines, and takes the cost off `rays`.
  Solution outline(const Lamp& lamp, std::int64_t& rays) const;

  /// Whether the lamp's light was followed to the patch. Of a `stale` solution a patch that was
  /// made anew in the same place has what the old one had.
  bool reaches(const Solution& solution, std::uint32_t patch, bool stale) const;

  /// lx that a patch gets from the lamp itself; 0 where its light was not followed to.
  float direct(const Solution& solution, std::uint32_t patch, bool stale) const;

  /// lx that a patch gets from others, also one that the lamp's light was not followed to, as far
  /// as that is known of a `stale` solution.
  Rgb reflected(const Solution& solution, std::uint32_t patch, bool stale);

  /// Adds what a solution's patches get from others, lx times `factor`, by patch.
  void add_reflected(const Solution& solution, const Rgb& factor, std::vector<Rgb>& light) const;
  /// The patches that `light` (lx) lists, where it is more than 0.
  std::vector<ReflectedLight::Piece> pieces(const std::vector<Rgb>& light) const;

 private:
  struct Link {
    std::uint32_t patch = kNoPatch;
    float range = 0.0F;  // m, to what is seen
  };
  struct PatchLinks {  // what one patch sees
    PatchLinks() = default;
    // A list that grows moves it: a box's own move may throw, by its declaration.
    PatchLinks(PatchLinks&&) noexcept = default;
    PatchLinks& operator=(PatchLinks&&) noexcept = default;

    std::vector<Link> links;
    Eigen::AlignedBox3d reach;
    bool counted = false;     // see cost_of()
    bool made = false;        // the making of its patch has been counted
    std::uint64_t scene = 0;  // the revision that they were found in
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
  const std::vector<Link>& links(std::uint32_t patch);
  Link link_of(const rays::Ray& ray, const rays::Hit& hit);
  std::int64_t update_links(std::uint32_t patch);
  std::int64_t start(Unfinished& work, std::int64_t rays);
  std::int64_t spread(Unfinished& work, std::int64_t rays);
  void follow_patch(Unfinished& work);
  std::int64_t prepare_balance(Unfinished& work, std::int64_t rays);
  std::int64_t balance(Unfinished& work, std::int64_t rays);
  void finish(Unfinished& work);
  float direct(const Lamp& lamp, std::uint32_t patch) const;

  const rays::Scene& scene_;
  Surfaces surfaces_;
  std::vector<PatchLinks> patch_links_;  // by patch; empty until it is queried
  std::vector<Known> known_;             // by shape, as of the last follow()
  std::uint64_t followed_ = 0;           // the mark of the scene's changes then
  std::uint64_t revision_ = 0;
  std::uint64_t updates_ = 0;
  std::vector<std::uint32_t> outdated_;  // shapes that were elsewhere since the last update began
  std::vector<Box> been_;                // by shape: where those of `outdated_` have been
  bool updating_ = false;
  std::vector<Box> boxes_;                // that the update under way is about
  std::vector<std::uint32_t> releasing_;  // numbers that are free after it
  std::size_t updated_ = 0;               // of `counted_`
  std::vector<std::uint32_t> counted_;    // patches, in the order in which they were
  std::vector<std::uint32_t> uncounted_;  // that have links all the same
};

}  // namespace angen::light
