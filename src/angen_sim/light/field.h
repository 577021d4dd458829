#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "light/lamp.h"
#include "light/surfaces.h"

namespace angen::light {

// SDF's white is 1, which would let light live for ever; white paint reflects no more than this.
constexpr float kLargestAlbedo = 0.9F;

/// What static and anchored shapes stand between: lx of lamps.
constexpr rays::Mobilities kStanding =
    rays::only(rays::Mobility::kStatic) | rays::only(rays::Mobility::kAnchored);

using Rgb = Eigen::Array4f;  // r g b and one unused, as vector units like it

/// What one lamp at level 1 and of white light gives every patch that its light comes to, by way of
/// static and anchored surfaces.
struct Solution {
  std::vector<std::uint32_t> patches;                       // its light comes to these
  std::unordered_map<std::uint32_t, std::uint32_t> places;  // of a patch in the other lists
  std::vector<float> direct;                                // lx
  std::vector<Rgb> reflected;                               // lx, from other patches
  mutable std::unordered_map<std::uint32_t, Rgb> beyond;    // lx, of other patches, once queried
  Eigen::AlignedBox3d bounds;                               // of the patches and the lamp
  bool valid = false;
  std::uint64_t stamp = 0;  // no two are alike
};

/// A partly computed solution; see Field::advance.
struct Unfinished {
  explicit Unfinished(const Lamp& of) : lamp(of) {}

  Lamp lamp;
  Solution solution;
  std::vector<rays::Ray> first;     // that find what the lamp shines on
  std::size_t cast = 0;             // of these
  std::size_t followed = 0;         // of the solution's patches: with what they throw back
  std::vector<Rgb> leaving;         // lx, of those
  bool balancing = false;           // all are followed
  std::vector<std::uint32_t> seen;  // by patch, the places of those that it sees
  std::vector<Rgb> albedos;
  int bounces = 0;
};

/// Diffuse light between the patches of a scene: what each sees is found by rays once, and anew
/// only where an anchored shape has moved.
class Field {
 public:
  explicit Field(const rays::Scene& scene) : scene_(scene), surfaces_(scene) {}

  /// Takes up what changed in the scene; `touched` gets the boxes in which anchored shapes moved.
  /// False when all must be found anew.
  bool follow(std::vector<Eigen::AlignedBox3d>& touched);

  std::uint32_t patch_at(std::uint32_t shape, const Vec3& point, const Vec3& normal);
  Rgb albedo(std::uint32_t shape) const;
  Rgb albedo_of(std::uint32_t patch) const;

  Solution solve(const Lamp& lamp);
  /// Goes on with a solution for the cost of about `rays` rays, at least one step. True when it is
  /// complete: the same as that of solve(), in however many parts. What follow() found changed in
  /// between makes it worthless.
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
  };
  using Anchored = std::vector<std::pair<rays::ShapeId, Eigen::AlignedBox3d>>;

  const std::vector<Link>& links(std::uint32_t patch);
  rays::Ray ray(std::uint32_t patch, std::size_t link) const;
  Link link_of(const rays::Ray& ray, const rays::Hit& hit);
  void update_links(const std::vector<Eigen::AlignedBox3d>& touched);
  std::size_t start(Unfinished& work, std::size_t rays);
  std::size_t spread(Unfinished& work, std::size_t rays);
  void follow_patch(Unfinished& work);
  void prepare_balance(Unfinished& work);
  bool bounce(Unfinished& work);
  float direct(const Lamp& lamp, std::uint32_t patch) const;

  const rays::Scene& scene_;
  Surfaces surfaces_;
  std::vector<Sight> sights_;  // by patch; empty until it is queried
  Anchored anchored_;
  std::uint64_t static_revision_ = 0;
  std::uint64_t anchored_revision_ = 0;
};

}  // namespace angen::light
