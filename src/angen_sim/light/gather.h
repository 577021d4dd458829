#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "light/solution.h"
#include "light/transport.h"

namespace angen::light {

/// A lamp and its solution, as a place receives its light.
struct Source {
  LampId id;
  const Lamp& lamp;
  const Solution& solution;
  std::uint64_t geometry = 0;  // grows when the lamp or static shapes in its light have moved
  bool stale = false;          // the lamp or standing shapes have changed since it was solved
};

/// Final gather at one place: finds the static surfaces over its hemisphere once, and the movers in
/// front of them after each change.
class Gather {
 public:
  Gather(const rays::Scene& scene, Field& field, const Pose& pose);

  /// Forgets the light of a lamp.
  void forget(LampId lamp) { received_.erase(lamp); }

  /// Whether any of the surfaces may be in the box (m, world).
  bool may_see(const Eigen::AlignedBox3d& box) const { return fixed_reach_.intersects(box); }

  /// Whether the anchored and moving shapes in front of the surfaces are up to date.
  bool movers_known() const;
  /// Keeps them up to date if `within` contains their reach: nothing has moved in it since.
  void hold_movers(const Eigen::AlignedBox3d& within);

  /// Light of all surfaces on the place. Extends `reach` by the light paths that movers could
  /// block.
  Gathered gather(const Source& source, Eigen::AlignedBox3d& reach);

 private:
  static constexpr std::uint64_t kNever = UINT64_MAX;

  struct Surface {
    Vec3 position;
    Vec3 normal;  // towards the place
    Rgb albedo;   // 0 without a hit
    double range = 0.0;
    std::uint32_t shape = UINT32_MAX;
    std::uint32_t patch = kNoPatch;
    std::uint64_t serial = 0;  // serial of the patch
  };
  struct Mover {
    Surface surface;
    bool anchored = false;
    std::uint32_t around = 0;  // a free mover's index of its first surface in `around_`
  };
  struct Received {                   // from one lamp, by direction
    std::uint64_t geometry = kNever;  // geometry of the source, for `direct`
    std::uint64_t stamp = kNever;     // stamp of the solution, for `reflected`
    std::uint64_t located = kNever;   // the field's revision, for `reflected`
    bool stale = false;               // the source is stale, for `reflected`
    bool lit = false;                 // any of `direct` is more than 0
    bool any = false;                 // any of `direct` or `reflected` is
    std::vector<float> direct;        // lx, without movers
    std::vector<Rgb> reflected;       // lx
  };
  Surface surface(const rays::Ray& ray, const rays::Hit& hit) const;  // without its patch
  Surface located(const rays::Ray& ray, const rays::Hit& hit) const;
  rays::Ray next(std::size_t i) const;
  void find_direct(const Source& source);
  void find_movers();
  void find_between();
  void find_around();
  void weigh();
  void locate(Surface& surface) const;
  void relocate();
  bool shaded(const Lamp& lamp, const Surface& surface, std::size_t i) const;
  const Received& received(const Source& source);
  void refine(const Source& source, std::vector<Rgb>& leaving);
  Rgb leaving(const rays::Ray& ray, const Source& source, std::size_t i, const Rgb& coarse);
  Rgb on_mover(const Mover& mover, const Source& source, std::size_t i, bool& in_play) const;

  const rays::Scene& scene_;
  Field& field_;
  Pose pose_;
  std::vector<rays::Ray> rays_;
  std::vector<Surface> surfaces_;
  std::vector<Mover> movers_;
  std::vector<std::uint32_t> before_;  // by direction: mover in front, or kNoMover
  std::vector<Surface> around_;
  std::size_t ways_ = 0;            // surfaces in `around_` for each free mover's point
  std::vector<float> next_ranges_;  // m, by direction: from the surface to the next static one
  std::vector<Rgb> between_;        // albedo of a moving shape before that one, or negative
  float left_ = 1.0F;               // share of earlier bounces' light that movers do not absorb
  std::map<LampId, Received> received_;
  std::vector<std::uint32_t> patches_;      // patches of all surfaces, each once
  std::vector<std::uint32_t> slots_;        // by direction: index of its patch in `patches_`
  std::uint64_t located_ = kNever;          // the field's revision, for the patches
  std::uint64_t movers_revision_ = kNever;  // the scene's revision, for `movers_`
  Eigen::AlignedBox3d fixed_reach_;  // reach of the paths to the surfaces and on to the next ones
  Eigen::AlignedBox3d reach_;        // also of the paths from movers
};

}  // namespace angen::light
