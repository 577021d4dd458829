#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "light/field.h"
#include "light/lighting.h"

namespace angen::light {

/// What one place sees over its hemisphere: static surfaces once, then what moves before them.
class Gather {
 public:
  Gather(const rays::Scene& scene, Field& field, const Pose& pose);

  /// Whether the static surfaces are still those that were seen.
  bool stands() const { return static_revision_ == scene_.static_revision(); }

  /// Forgets what came from lamps that are gone.
  void forget(const std::function<bool(LampId)>& gone);

  /// Looks for anchored and moving shapes before them.
  void look();

  /// What a lamp at level 1 sends to the place, direct and by way of the surfaces.
  Transport transport(LampId id, const Lamp& lamp, const Solution& solution);

 private:
  struct Surface {
    Vec3 position;
    Vec3 normal;  // towards the place
    Rgb albedo;   // 0 where nothing is met
    double range = 0.0;
    std::uint32_t patch = kNoPatch;
  };
  struct Mover {
    Surface surface;
    bool anchored = false;
    std::uint32_t around = 0;  // the first of the surfaces that a point of a free one sees
  };
  struct Received {  // from one lamp, by direction
    std::uint64_t stamp = UINT64_MAX;
    std::vector<float> direct;   // lx, when nothing moves
    std::vector<Rgb> reflected;  // lx
  };
  struct Direct {
    double illuminance = 0.0;  // lx
    double radiance = 0.0;     // cd/m^2, the lamp's own share of the one-pixel view
  };

  Surface surface(const rays::Ray& ray, const rays::Hit& hit) const;
  rays::Ray next(std::size_t i) const;
  void look_next();
  void look_around();
  void weigh();
  bool shaded(const Lamp& lamp, const Surface& surface, std::size_t i) const;
  Direct direct(const Lamp& lamp) const;
  const Received& received(LampId id, const Lamp& lamp, const Solution& solution);
  Rgb on_mover(const Mover& mover, const Lamp& lamp, const Solution& solution, std::size_t i) const;

  const rays::Scene& scene_;
  Field& field_;
  Pose pose_;
  std::uint64_t static_revision_;
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
};

}  // namespace angen::light
