#pragma once

#include <vector>

#include "light/lighting.h"

namespace angen::light {

/// The surfaces that light may come from on its way to one place, found once for all lamps by
/// following fixed directions back from there.
class Paths {
 public:
  Paths(const rays::Scene& scene, const Pose& pose);

  /// What a lamp at level 1 sends to the place, direct and by way of the surfaces.
  Transport transport(LampId id, const Lamp& lamp) const;

 private:
  using Rgb = Eigen::Array3d;

  struct Vertex {
    Vec3 position;
    Vec3 normal;     // towards where the path came from
    Rgb throughput;  // product of the albedos from the place to this surface, its own included
    std::size_t path;
  };
  struct Direct {
    double illuminance = 0.0;  // lx
    double radiance = 0.0;     // cd/m^2, the lamp's own share of the one-pixel view
  };

  void trace();
  Direct direct(const Lamp& lamp) const;
  double arriving(const Lamp& lamp, const Vertex& vertex, std::size_t index) const;

  const rays::Scene& scene_;
  Pose pose_;
  std::vector<Vertex> vertices_;   // bounce by bounce, each in the paths' order
  std::size_t second_ = 0;         // the first vertex of the second bounce
  std::size_t last_ = 0;           // the first vertex of the last bounce
  Rgb mean_albedo_ = Rgb::Zero();  // of what paths meet after their first surface; sky is black
};

}  // namespace angen::light
