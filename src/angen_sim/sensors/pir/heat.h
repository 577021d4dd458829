#pragma once

#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plugin/view.h"
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

  /// Requests rays towards every such surface; none where nothing moved since the last time.
  void aim(const View& view, RayBatch& rays);

  /// Flux on the positive element less that on the negative one, in W, now.
  double flux(Hits hits, Nanoseconds now);

  /// What it comes from, until something moves or a surface is set to another temperature. The
  /// object is replaced when it changes.
  const std::shared_ptr<const HeatSources>& sources() const { return sources_; }

  /// The part of its changes that the air around caused, in W: too slow for a detector to pass.
  double drift() const { return drift_; }

  /// Nothing is sampled and the air is not followed until something moves or a surface is set to
  /// another temperature.
  void rest() { rests_ = true; }

  /// Whether it has yet to sample moved surfaces.
  bool pending() const { return pending_; }

  /// Samples all surfaces at the next aim().
  void forget() { revision_ = UINT64_MAX; }

 private:
  /// The solid angle of one ray.
  struct Sample {
    std::size_t surface;  // in shapes_
    double factor;        // m^2 sr, of the elements' difference, where the ray hits the surface
  };

  /// The rays to a shape that stays where it is, and what each counts.
  struct Scan {
    Eigen::AlignedBox3d box;  // the shape's
    Eigen::Matrix3d rotation;
    bool near = false;
    std::vector<rays::Ray> rays;
    std::vector<double> factors;     // as in Sample
    std::vector<std::size_t> parts;  // where each window begins
    bool is_cleared = false;         // of the rays that static shapes block
    std::uint64_t static_revision = 0;
  };

  std::vector<rays::Ray> all_rays(const Pose& pose) const;
  bool sees(const Eigen::AlignedBox3d& box, const Pose& pose) const;
  void aim_at(const rays::WarmShape& shape, const Pose& pose, const View& view, RayBatch& rays);
  void scan_all(const rays::WarmShape& shape, const Pose& pose, const View& view, Scan& found);
  void scan(const Window& seen, const Pose& pose, const View& view, Scan& found);
  void clear_blocked(const View& view, Scan& found);
  void take_visible(std::size_t first, const View& view, RayBatch& rays);
  bool waits(Nanoseconds now) const;
  bool radiates(const rays::WarmShape& shape, const View& view) const;
  bool reheat(const View& view);
  bool follow_air(const View& view);
  void publish_sources();

  FresnelLens lens_;
  double cell_width_ = 0.0;   // rad, of the solid angle of a ray
  double cell_height_ = 0.0;  // rad
  double range_ = 0.0;
  double opening_ = 0.0;
  Nanoseconds period_ = 0;
  std::vector<std::uint32_t> shapes_;  // that radiate more or less than the air …
  HeatSources radiating_;              // … and how they do
  std::shared_ptr<const HeatSources> sources_ = std::make_shared<HeatSources>();  // a copy of that
  std::vector<Sample> samples_;
  std::uint64_t revision_ = UINT64_MAX;
  Pose pose_;
  bool near_ = false;                              // whether a surface is where the lens looks
  std::unordered_map<std::uint32_t, Scan> scans_;  // by shape, from pose_
  std::vector<rays::Ray> probes_;
  std::vector<rays::Hit> probed_;
  bool sampled_ = false;  // whether aim() has requested rays
  bool pending_ = false;  // something has moved since
  double flux_ = 0.0;
  double air_ = 0.0;  // K
  double drift_ = 0.0;
  bool rests_ = false;
  std::uint64_t surfaces_set_ = UINT64_MAX;  // at the last aim()
  Nanoseconds felt_at_ = -1;                 // that air, in whole seconds
};

}  // namespace angen::sensors
