#pragma once

#include <cstdint>
#include <vector>

#include "core/id.h"
#include "core/pose.h"
#include "core/slots.h"
#include "rays/scene.h"

/// Lux at a point from lamps, surfaces and rays.
namespace angen::light {

struct LampTag;
using LampId = Id<LampTag>;

struct Lamp {
  enum class Type { kPoint, kSpot, kDirectional };
  Type type = Type::kPoint;
  Pose pose;                        // world; spots and directional ones shine along `direction`
  Vec3 direction = -Vec3::UnitZ();  // unit, in its own frame
  double luminous_flux = 800.0;     // lm at level 1 (point: isotropic); directional: lx
  Eigen::Vector3f color{1.0F, 1.0F, 1.0F};  // linear r g b, scaled so that its luminance is 1
  double radius = 0.05;                     // m, size of the luminous sphere
  double inner_angle = 0.0;                 // rad, spot: full angle of its evenly lit cone
  double outer_angle = 0.0;                 // rad, spot: full angle beyond which it is dark
  bool cast_shadows = true;
};

/// What one lamp at level 1 sends to one place.
struct Transport {
  LampId lamp;
  double illuminance = 0.0;                            // lx
  Eigen::Vector3f radiance = Eigen::Vector3f::Zero();  // mean of a one-pixel view, r g b in cd/m^2
};

/// A place of measurement that remembers its transports while geometry stands still. A plain value,
/// held by a sensor.
struct Probe {
  Pose pose;
  std::uint64_t revision = UINT64_MAX;  // of the scene and lamp set that `transports` belong to
  std::uint64_t lamps_revision = UINT64_MAX;
  std::vector<Transport> transports;
};

/// A lamp that shines, and at what share of its flux.
struct Lit {
  Lamp lamp;
  double level = 0.0;
};

struct Sample {
  double illuminance = 0.0;                         // lx on a plane through the point, normal x
  Eigen::Vector3f color = Eigen::Vector3f::Zero();  // mean colour of the view, 0..1 (tone mapped)
};

class Lighting {
 public:
  explicit Lighting(const rays::Scene& scene);

  LampId add(const Lamp& lamp, double level);
  void remove(LampId lamp);
  void set_level(LampId lamp, double level);  // share of luminous_flux; 0 and less is dark
  double level(LampId lamp) const;
  void move(LampId lamp, const Pose& pose);
  std::vector<Lit> lit() const;  // those of a level above 0

  /// Illuminance at pose.position on the plane whose normal is pose's x axis, direct light with
  /// shadows plus interreflection, and the mean colour that a square pixel of 60 degrees along x
  /// sees: a mean luminance of L cd/m^2 gives L / (L + 50) in each channel. Albedos above 0.9 count
  /// as 0.9. A shape around a lamp or around the place keeps the light out, the sensor's own
  /// housing too: leave it out of the scene or put the place before it. The scene must be
  /// committed. Same scene, same lamps, same pose: same bits.
  Sample measure(Probe& probe, const Pose& pose) const;

 private:
  struct Entry {
    Lamp lamp;
    double level;
  };
  const rays::Scene& scene_;
  Slots<Entry, LampTag> lamps_;
  std::uint64_t lamps_revision_;  // no two Lightings share one
};

}  // namespace angen::light
