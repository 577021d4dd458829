#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "light/field.h"
#include "light/transport.h"

namespace angen::light {

/// A lamp as a place receives its light.
struct Source {
  LampId id;
  const Lamp& lamp;
  const Solution& solution;
  std::uint64_t geometry = 0;  // grows when the lamp has moved or walls have around it
  bool stale = false;          // the solution is not what it would be if it were found now
};

/// What one place sees over its hemisphere: static surfaces once, then what moves before them.
class Gather {
 public:
  Gather(const rays::Scene& scene, Field& field, const Pose& pose);

  /// Forgets what came from a lamp.
  void forget(LampId lamp) { received_.erase(lamp); }

  /// Whether any of the surfaces may be in the box.
  bool may_see(const Eigen::AlignedBox3d& box) const { return fixed_reach_.intersects(box); }

  /// Whether the anchored and moving shapes before the surfaces are known as they are now.
  bool movers_known() const;
  /// Nothing has moved in the box since they were found.
  void hold_movers(const Eigen::AlignedBox3d& within);

  /// How many surfaces' patches see what prepare() has not been counted for.
  std::size_t lacking(const Source& source);
  /// Finds what they see, for the cost of about `rays` rays, which it takes off. True when that is
  /// all.
  bool prepare(const Source& source, std::int64_t& rays);

  /// What all surfaces send to the place. `reach` grows by the ways of its light on which shapes
  /// that move could stand.
  Gathered gather(const Source& source, Eigen::AlignedBox3d& reach);

 private:
  static constexpr std::uint64_t kNever = UINT64_MAX;

  struct Surface {
    Vec3 position;
    Vec3 normal;  // towards the place
    Rgb albedo;   // 0 where nothing is met
    double range = 0.0;
    std::uint32_t shape = UINT32_MAX;
    std::uint32_t patch = kNoPatch;
    std::uint64_t serial = 0;  // of the patch
  };
  struct Mover {
    Surface surface;
    bool anchored = false;
    std::uint32_t around = 0;  // the first of the surfaces that a point of a free one sees
  };
  struct Received {                   // from one lamp, by direction
    std::uint64_t geometry = kNever;  // that `direct` belongs to
    std::uint64_t stamp = kNever;     // of the solution that `reflected` belongs to
    std::uint64_t located = kNever;   // the patches that it belongs to
    bool stale = false;               // as that was
    bool lit = false;                 // any of `direct` is more than 0
    bool any = false;                 // any of both is
    std::vector<float> direct;        // lx, when nothing moves
    std::vector<Rgb> reflected;       // lx
  };
  Surface surface(const rays::Ray& ray, const rays::Hit& hit) const;
  rays::Ray next(std::size_t i) const;
  bool lacks(std::uint32_t patch, const Source& source) const;
  void find_direct(const Source& source);
  void find_movers();
  void find_between();
  void find_around();
  void weigh();
  void locate(Surface& surface) const;
  void relocate();
  bool shaded(const Lamp& lamp, const Surface& surface, std::size_t i) const;
  const Received& received(const Source& source);
  Rgb on_mover(const Mover& mover, const Source& source, std::size_t i, bool& in_play) const;

  const rays::Scene& scene_;
  Field& field_;
  Pose pose_;
  std::vector<rays::Ray> rays_;
  std::vector<Surface> surfaces_;
  std::vector<Mover> movers_;
  std::vector<std::uint32_t> before_;  // by direction: which mover hides the surface, or kNoMover
  std::vector<Surface> around_;
  std::size_t ways_ = 0;            // surfaces in `around_` for each free mover's point
  std::vector<float> next_ranges_;  // m, by direction: from the surface on, to the next
  std::vector<Rgb> between_;  // albedo of the moving shape before that; negative where none is
  float left_ = 1.0F;         // share that moving shapes leave of light still farther back
  std::map<LampId, Received> received_;
  std::vector<std::uint32_t> patches_;      // of all surfaces, each once
  std::vector<std::uint32_t> slots_;        // by direction: where its patch is in that list
  std::uint64_t located_ = kNever;          // the field's revision that patches belong to
  std::uint64_t movers_revision_ = kNever;  // the scene's, that `movers_` belong to
  Eigen::AlignedBox3d fixed_reach_;  // of the ways between place and surfaces, and to the next
  Eigen::AlignedBox3d reach_;        // and of those from what moves
};

}  // namespace angen::light
