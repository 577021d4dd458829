#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "light/field.h"
#include "light/lighting.h"

namespace angen::light {

/// What surfaces send to a place of one lamp's light, were it white.
struct Gathered {
  Rgb illuminance = Rgb::Zero();  // lx
  Rgb view = Rgb::Zero();         // lx leaving what the one-pixel view sees, their mean
};

/// A lamp as a place receives its light.
struct Source {
  LampId id;
  const Lamp& lamp;
  const Solution& solution;
  std::uint64_t geometry = 0;  // grows when the lamp has moved or walls have around it
  bool lasting = true;         // the solution is what it would be if it were found now
};

/// What a lamp at level 1 sends to a place, straight and by way of surfaces. `reach` grows by the
/// ways of its light on which shapes that move could stand.
Transport transport(const rays::Scene& scene, const Pose& pose, const Lamp& lamp,
                    const Gathered& gathered, Eigen::AlignedBox3d& reach);

/// What one place sees over its hemisphere: static surfaces once, then what moves before them.
class Gather {
 public:
  Gather(const rays::Scene& scene, Field& field, const Pose& pose);

  /// Forgets what came from lamps that are gone.
  void forget(const std::function<bool(LampId)>& gone);

  /// Whether any of the surfaces may be in the box.
  bool may_see(const Eigen::AlignedBox3d& box) const { return fixed_reach_.intersects(box); }

  /// Forgets the anchored and moving shapes before them.
  void forget_movers() { movers_found_ = false; }

  /// What they all send to the place. Finds shapes that move, unless they are known.
  Gathered gather(const Source& source, Eigen::AlignedBox3d& reach);

  /// Finds what of it only geometry decides, so that gather() costs less.
  void prepare(LampId id, const Lamp& lamp, std::uint64_t geometry);

 private:
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
  struct Received {                       // from one lamp, by direction
    std::uint64_t geometry = UINT64_MAX;  // that `direct` belongs to
    std::uint64_t stamp = UINT64_MAX;     // of the solution that `reflected` belongs to
    bool lit = false;                     // any of `direct` is more than 0
    bool any = false;                     // any of both is
    std::vector<float> direct;            // lx, when nothing moves
    std::vector<Rgb> reflected;           // lx
  };
  Surface surface(const rays::Ray& ray, const rays::Hit& hit) const;
  rays::Ray next(std::size_t i) const;
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
  std::vector<std::uint32_t> patches_;  // of all surfaces, each once
  std::vector<std::uint32_t> slots_;    // by direction: where its patch is in that list
  std::uint64_t located_ = UINT64_MAX;  // the field's revision that patches belong to
  bool movers_found_ = false;
  Eigen::AlignedBox3d fixed_reach_;  // of the ways between place and surfaces, and to the next
  Eigen::AlignedBox3d reach_;        // and of those from what moves
};

}  // namespace angen::light
