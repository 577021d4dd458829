#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/warming.h"
#include "plugin/plugin.h"
#include "rays/shaft.h"
#include "sensors/pir/fresnel_lens.h"

namespace angen::sensors {

/// The flux on a detector's elements from surfaces that stay where they are, while their
/// temperatures change in a known way.
struct HeatSources {
  struct Source {
    double factor;  // m^2 sr: W on the elements' difference for a radiance of 1
    Warming course;
  };
  std::vector<Source> all;
  double air_fourth = 0.0;  // K^4, of the air's temperature

  /// Flux on the positive element less that on the negative one, in W.
  double flux(Nanoseconds time) const;
  bool operator==(const HeatSources& o) const;
  /// Whether the flux no longer changes.
  bool constant(Nanoseconds time) const;
};

/// Heat radiation on a detector's elements, from surfaces that are warmer or colder than the air
/// around the detector.
class Heat {
 public:
  Heat() = default;
  /// Sees to `range` in m, every `period`. `opening` in m^2 is the area of a facet times the
  /// transmittance of the lens and the detector's window.
  Heat(FresnelLens lens, double range, double opening, Nanoseconds period);

  /// Looks at every such surface; at none if nothing moved since the last time.
  void sample(const View& view);

  /// Flux on the positive element less that on the negative one, in W.
  double flux(Nanoseconds now);

  /// Its sources, until something moves or a surface is set to another temperature. The
  /// object is replaced when it changes.
  const std::shared_ptr<const HeatSources>& sources() const { return sources_; }

  /// The part of its changes that the air around caused, in W: too slow for a detector to pass.
  double drift() const { return drift_; }

  /// The shape whose part of the flux has changed most, of those that changed last; UINT32_MAX if
  /// none has.
  std::uint32_t mover() const { return mover_; }

  /// Nothing is sampled and the air is not followed until something moves or a surface is set to
  /// another temperature.
  void rest() { rests_ = true; }

  /// Whether it has yet to sample moved surfaces.
  bool pending() const { return pending_; }

  /// Samples all surfaces at the next sample().
  void forget() { revisions_.shapes = UINT64_MAX; }

 private:
  /// The solid angle of one ray.
  struct Cell {
    double azimuth;  // rad
    double level;    // the ray's horizontal part …
    double up;       // … and its vertical one
    double factor;   // m^2 sr, of the elements' difference, where the ray hits the surface
  };

  /// A shape as the detector sees it, as long as neither moves.
  struct Scan {
    Eigen::AlignedBox3d box;
    Eigen::Matrix3d rotation;
    std::optional<std::vector<Window>> windows;  // windows of the lens, around the shape
    /// The cells of each window that it fills; found when they are needed.
    std::vector<std::vector<Cell>> parts;
    // Blockers of its shaft, when it was last looked at; none if `wall` hid it …
    std::optional<std::uint64_t> blockers;
    double factor = 0.0;  // … and the part of it that was visible, m^2 sr
    bool is_known = false;
    std::uint64_t moment = 0;         // rays::Scene::moment() up to which it is known
    std::uint32_t wall = UINT32_MAX;  // the shape that hid it whole, when one last did
  };

  std::vector<rays::Ray> all_rays(const Pose& pose) const;
  void look_from(const Pose& pose);
  bool sees(const Eigen::AlignedBox3d& box) const;
  double factor_of(const rays::WarmShape& shape, const View& view);
  Scan& scan_of(const rays::WarmShape& shape);
  double look_at(std::uint32_t shape, Scan& found, const rays::Scene& rays) const;
  const std::vector<Window>& windows_of(Scan& found) const;
  double seen_factor(const rays::Shaft& shaft, Scan& found) const;
  std::vector<Cell> scan(const Window& seen, const rays::Shaft& shaft) const;
  double visible(const std::vector<Cell>& cells, const rays::Shaft& shaft) const;
  rays::Ray ray_to(const Cell& cell) const;
  bool waits(Nanoseconds now) const;
  bool radiates(const rays::WarmShape& shape, Nanoseconds now) const;
  bool reheat(const View& view);
  bool follow_air(const View& view);
  void publish_sources();

  FresnelLens lens_;
  double cell_width_ = 0.0;   // rad, of the solid angle of a ray
  double cell_height_ = 0.0;  // rad
  double range_ = 0.0;
  double opening_ = 0.0;
  Nanoseconds period_ = 0;
  std::vector<std::uint32_t> shapes_;  // shapes that radiate more or less than the air …
  HeatSources radiating_;              // … and how they do
  std::shared_ptr<const HeatSources> sources_ = std::make_shared<HeatSources>();  // a copy of that
  Revisions revisions_{UINT64_MAX, UINT64_MAX};  // the surfaces at its last sample
  Pose pose_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();  // rotation of pose_
  Vec3 axis_ = Vec3::UnitX();                               // axis of a cone around its window
  double cone_ = 0.0;                                       // rad, from there to the cone's side
  bool near_ = false;                              // whether a surface is where the lens looks
  std::unordered_map<std::uint32_t, Scan> scans_;  // by shape, from pose_
  std::uint32_t mover_ = UINT32_MAX;
  double most_ = 0.0;     // m^2 sr K^4, that its part of the flux changed in this sample
  bool pending_ = false;  // something has moved since
  double flux_ = 0.0;
  double air_ = 0.0;  // K
  double drift_ = 0.0;
  bool rests_ = false;
  Nanoseconds felt_at_ = -1;  // when that air was felt, in whole seconds
};

}  // namespace angen::sensors
