#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "light/lamp.h"
#include "light/surfaces.h"

namespace angen::light {

// SDF's white is 1, which would let light live for ever; white paint reflects no more than this.
constexpr float kLargestAlbedo = 0.9F;

using Rgb = Eigen::Array4f;  // r g b and one unused, as vector units like it

/// What one lamp at level 1 and of white light gives every patch that its light comes to, by way of
/// static and anchored surfaces.
struct Solution {
  std::vector<std::uint32_t> patches;                       // its light comes to these
  std::unordered_map<std::uint64_t, std::uint32_t> places;  // in the other lists, by serial
  std::vector<float> direct;                                // lx
  std::vector<Rgb> reflected;                               // lx, from other patches
  Eigen::AlignedBox3d bounds;                               // of the patches and the lamp
  std::uint64_t stamp = 0;                                  // no two are alike
};

/// A partly computed solution; see Field::advance.
struct Unfinished {
  explicit Unfinished(const Lamp& of) : lamp(of) {}

  Lamp lamp;
  Solution solution;
  std::vector<rays::Ray> first;       // that find what the lamp shines on
  std::size_t cast = 0;               // of these
  std::size_t followed = 0;           // of the solution's patches: with what they throw back
  std::vector<std::uint32_t> places;  // by patch, in the solution's lists; kNoPatch for none
  std::vector<Rgb> leaving;           // lx, of those
  bool balancing = false;             // all are followed
  std::vector<std::uint32_t> seen;    // by patch, the places of those that it sees
  std::vector<Rgb> albedos;
  int bounces = 0;
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
  std::uint64_t revision() const { return revision_; }  // grows when patches are forgotten
  /// Forgets the patches where follow() has found changes up to now; they are made anew when they
  /// are met. Begins to find anew what others see there.
  void start_update();
  bool updating() const { return updating_; }
  /// Goes on with it for the cost of about `rays` rays, at least one step; returns the cost.
  std::size_t update(std::size_t rays);

  std::uint32_t patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal);
  std::uint64_t serial(std::uint32_t patch) const { return surfaces_[patch].serial; }
  bool alive(std::uint32_t patch) const { return surfaces_[patch].alive; }
  Rgb albedo(std::uint32_t shape) const;
  Rgb albedo_of(std::uint32_t patch) const;

  Solution solve(const Lamp& lamp);
  /// Goes on with a solution for the cost of about `rays` rays, at least one step. True when it is
  /// complete: the same as that of solve(), in however many parts, if nothing has changed since.
  bool advance(Unfinished& work, std::size_t rays);

  /// lx that a patch gets from the lamp itself; 0 where its light was not followed to.
  float direct(const Solution& solution, std::uint32_t patch) const;

  /// lx that a patch gets from others, also one that the lamp's light was not followed to.
  Rgb reflected(const Solution& solution, std::uint32_t patch);

 private:
  struct Link {
    std::uint32_t patch = kNoPatch;
    float range = 0.0F;  // m, to what is seen
  };
  struct Sight {  // what one patch sees
    std::vector<Link> links;
    Eigen::AlignedBox3d reach;
    bool charged = false;  // a solution has counted its cost
  };
  using Box = Eigen::AlignedBox3d;
  using Boxes = std::vector<std::pair<rays::ShapeId, Box>>;

  void compare(Boxes& known, Boxes now, bool is_static, std::vector<Change>& changes);
  void note(rays::ShapeId shape, const Box& box, bool is_static, std::vector<Change>& changes);
  void forget_near(const Box& box);
  const std::vector<Link>& links(std::uint32_t patch);
  Link link_of(const rays::Ray& ray, const rays::Hit& hit);
  std::size_t update_links(std::uint32_t patch);
  std::size_t start(Unfinished& work, std::size_t rays);
  std::size_t spread(Unfinished& work, std::size_t rays);
  std::size_t cost_of(std::uint32_t patch);
  void follow_patch(Unfinished& work);
  void prepare_balance(Unfinished& work);
  bool bounce(Unfinished& work);
  void finish(Unfinished& work);
  float direct(const Lamp& lamp, std::uint32_t patch) const;

  const rays::Scene& scene_;
  Surfaces surfaces_;
  std::vector<Sight> sights_;  // by patch; empty until it is queried
  Boxes static_;               // as of the last follow()
  Boxes anchored_;
  bool begun_ = false;
  std::uint64_t static_revision_ = 0;
  std::uint64_t anchored_revision_ = 0;
  std::uint64_t revision_ = 0;
  std::map<std::uint32_t, Box>
      outdated_;  // by shape: where it has been since the last update began
  bool updating_ = false;
  std::vector<Box> boxes_;                // that the update under way is about
  std::vector<std::uint32_t> releasing_;  // numbers that are free after it
  std::uint32_t updated_ = 0;             // patches that it has gone through
};

}  // namespace angen::light
