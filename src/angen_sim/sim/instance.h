#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plugin/library.h"
#include "rays/gaze.h"
#include "sim/rhythm.h"
#include "sim/snapshot.h"
#include "sim/stage.h"

namespace angen::sim {

struct DeviceInstance {
  std::string kind;
  std::string name;
  std::shared_ptr<const Plugin> plugin;  // keeps its library loaded
  std::unique_ptr<Device> device;
  Element element;           // its <plugin>
  SavedParams started_with;  // what it would have saved then
  Reading scratch;           // what it reports is written here, then compared
  std::shared_ptr<const Reading> last;
  Nanoseconds updated = 0;     // when it last was
  Nanoseconds idle_until = 0;  // unless it is commanded or its model wakes
  bool to_report = true;       // it was updated since its last report
  Nanoseconds cost = 0;        // CPU time that the meter counts

  /// Tells it of the ticks that it was left out of, before the one of `now`.
  void catch_up(Nanoseconds now, Nanoseconds step) {
    if (now - step > updated) device->skip(now - step - updated);
    updated = now - step;
  }
};

/// One of a sensor's sets of rays, measured at the pose that it has now.
struct Look {
  Look(RayBatch rays, Stage& stage)
      : gaze(std::move(rays), stage.rays), view(stage.sights, gaze.reach()) {}

  /// Measures anew, after static shapes came or went; the stage must be committed.
  void measure(Stage& stage);
  /// The hits of now. Returns whether they are surely those of the look before.
  bool look(const Stage& stage, Sights::Parted& scratch, std::vector<rays::Hit>& hits);

  rays::Gaze gaze;
  Sights::View view;
  bool changed = true;            // since it was last looked at, or met what moves then
  Sights::Moment settled_at = 0;  // movers that have not moved since are settled in the gaze
  std::size_t settled = 0;        // how many
};

/// Where the light comes by that a sensor measures, from where it stands.
struct LightWays {
  const light::Probe* probe;
  Sights::View view;        // in the probe's reach
  Eigen::AlignedBox3d box;  // that
  Sights::Moment looked;    // it has seen all that happened before
};

/// What an instance asked for of the world besides rays, the time and its own pose.
struct Asked {
  bool contacts = false;
  bool light = false;
  bool devices = false;  // what they tell
  bool other = false;

  bool any() const { return contacts || light || devices || other; }
  Asked operator|(const Asked& o) const {
    return {contacts || o.contacts, light || o.light, devices || o.devices, other || o.other};
  }
};

struct SensorInstance {
  // What a due time at rest looks at stands together: with many sensors it comes from far away.
  std::vector<std::unique_ptr<Look>> looks;  // by stance, from where it stands
  std::unique_ptr<LightWays> light;          // none where light may come from anywhere
  Rhythm rhythm;
  Sights::Moment seen = 0;  // it has seen all that happened before
  int calm = 0;             // so many looks in a row found nothing changed since the one before
  Rest rest = Rest::kBusy;
  Asked asked{false, false, false, true};  // for its reading
  bool link_moves = true;                  // or stands where it is for ever
  bool published = false;                  // `scratch`, as `told`
  bool echoes = false;                     // told.echo stands for its looks

  std::string kind;
  std::string name;
  std::uint64_t key = 0;  // of its random numbers
  std::shared_ptr<const Plugin> plugin;
  std::unique_ptr<Sensor> sensor;
  std::shared_ptr<const desc::Sensor> desc;
  std::uint32_t link = 0;  // in its model
  Pose pose;               // in the link's frame
  std::string topic;
  std::string frame;
  bool attached = false;
  std::vector<std::string> collisions;         // full names, by ContactRef
  std::vector<physics::CollisionId> touching;  // the same
  Reading scratch;                             // the latest
  Told told;                                   // the latest published, as snapshots have it
  Pose seen_from;                              // when it last looked, if its link moves
  std::uint64_t contacts_seen = 0;             // their revisions when it last looked
  std::uint64_t light_seen = 0;                // as well
  double quiet_chance = 0.0;                   // of its noise, while it echoes
  Nanoseconds quiet_until = 0;                 // known of its noise, for leaps
  Nanoseconds loud_at = 0;                     // as well, when later than now
  Nanoseconds cost = 0;                        // CPU time that the meter counts
};

/// A model that is in the world, with all that acts and looks in it.
struct LiveModel {
  std::shared_ptr<const desc::Model> desc;
  Parts parts;
  std::vector<DeviceInstance> devices;
  std::vector<SensorInstance> sensors;
  std::int64_t awake_at = 0;     // the last tick at whose end some of it was awake
  std::uint32_t first_link = 0;  // index of its first link in Structure::links
  std::uint32_t first_joint = 0;
  std::uint32_t first_device = 0;
  std::uint32_t first_sensor = 0;
  std::uint32_t first_light = 0;
};

ModelInfo info_of(const desc::Model& model);

/// What a model's plug-ins and the world's make of it, not yet in the world. Throws Error for a
/// plug-in or parameter that is wrong; `warnings` tells of sensors without a plug-in.
void make_instances(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                    const Vec3& gravity, Catalog& catalog, std::vector<std::string>& warnings);

/// A sensor of `live`, on its link number `link`; shares its description.
SensorInstance make_sensor(const LiveModel& live, std::uint32_t link,
                           std::shared_ptr<const desc::Sensor> shared, const std::string& name,
                           const Vec3& gravity, Catalog& catalog);

}  // namespace angen::sim
