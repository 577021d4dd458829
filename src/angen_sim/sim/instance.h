#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plugin/library.h"
#include "rays/ray_cache.h"
#include "sim/engines.h"
#include "sim/samples_ahead.h"
#include "sim/schedule.h"
#include "sim/snapshot.h"

namespace angen::sim {

struct DeviceInstance : DeviceInfo {
  std::unique_ptr<Device> device;
  Element element;                 // its <plugin>
  int own_light = -1;              // in Parts::lamps: the light that is this lamp by itself
  SavedParams started_with;        // the parameters to save at its start
  Reading scratch;                 // it reports into this, which is then compared
  std::size_t checked_fields = 0;  // how many of these
  std::shared_ptr<const Reading> last;
  StateChanges::Device changes;
  Vec3 offset = Vec3::Zero();  // DeviceView::place() in that state, in its model's frame
  LimbPoses limbs;             // limbs with that state
  Nanoseconds updated = 0;     // when it last was
  Nanoseconds idle_until = 0;  // unless it is commanded or its model wakes
  bool to_report = true;       // it was updated since its last report
  Nanoseconds cost = 0;        // CPU time that the meter counts
  std::string error;           // text of its exception; it is not called again

  /// Has it skip the ticks without updates before the one of `now`.
  void catch_up(Nanoseconds now, Nanoseconds step) {
    if (now - step > updated) device->skip(now - step - updated);
    updated = now - step;
  }
};

/// The cached rays of one of a sensor's ray sets, at the sensor's present pose.
struct CachedScan {
  CachedScan(RayBatch rays, Engines& engines)
      : cache(std::move(rays), engines.rays), region(engines.movers, cache.reach()) {}

  /// Casts against the static scene again, after static shapes came or went; the scene must be
  /// committed.
  void measure(Engines& engines);
  /// The hits now; false if they are those of the last cast.
  bool cast(const Engines& engines, MoverIndex::SplitMovers& scratch, std::vector<rays::Hit>& hits);

  rays::RayCache cache;
  MoverIndex::WatchRegion region;
  MoverIndex::Moment settled_at = 0;  // movers that have not moved since are settled in the cache
  std::size_t settled = 0;            // how many
  bool may_differ = true;             // the next hits from those of the last cast
};

/// The region through which light reaches a sensor that measures it, at its present pose.
struct WatchedLight {
  const light::Probe* probe;
  MoverIndex::WatchRegion region;  // the probe's reach
  Eigen::AlignedBox3d box;         // box of the region
  MoverIndex::Moment sampled;      // changes before it are in the sample
};

/// The region of rays that a sensor has named instead of all shapes.
struct WatchedRays {
  MoverIndex::WatchRegion region;
  Eigen::AlignedBox3d box;  // the region's
  std::uint64_t revision;   // grows when something in it changes
};

/// Parts of the world that an instance queried besides rays, the time and its own pose.
struct Queried {
  bool contacts = false;
  bool light = false;
  bool devices = false;  // the set of devices
  bool other = false;
  StateChanges::Fields fields = 0;  // by which it queried devices
  bool heat = false;                // temperatures of surfaces
  bool heat_set = false;            // only when they begin to change
  bool model = false;               // links and joints of its own model
  Heights heights{};                // at which it queried devices

  bool any() const { return contacts || light || devices || other || heat || heat_set || model; }
  /// Whether only its model, states of devices, and what happens in the regions that it watches,
  /// change the answers; `near`: temperatures matter in these only.
  bool wakes(bool near) const {
    return !(contacts || light || other || heat || (heat_set && !near));
  }
  Queried operator|(const Queried& o) const {
    return {contacts || o.contacts, light || o.light,  devices || o.devices,
            other || o.other,       fields | o.fields, heat || o.heat,
            heat_set || o.heat_set, model || o.model,  heights | o.heights};
  }
};

struct SensorInstance : SensorInfo {
  // Each due time reads these, and the schedule beside them: with many sensors they are not
  // in the CPU's cache.
  std::vector<std::unique_ptr<CachedScan>> scans;  // by ray set
  std::unique_ptr<WatchedLight> light;             // null if light may come from anywhere
  std::unique_ptr<WatchedRays> near;               // null if all shapes matter
  MoverIndex::Moment seen = 0;                     // its last sample has all changes before
  bool idle = false;        // its samples are replaced until something changes
  bool up_to_date = false;  // the last published reading has the values of its last sample
  bool lasts = false;       // while nothing changes, its samples are the last one for some time
  int unchanged = 0;        // due times in a row at which all that it queries was
  Queried queried{false, false, false, true, 0, false, false, false, {}};  // for its reading
  bool link_moves = true;  // false if its link is static

  std::unique_ptr<Sensor> sensor;
  std::vector<Noise> noise;                    // noise that is added to its readings
  std::uint32_t link = 0;                      // in its model
  std::vector<std::string> collisions;         // full names, by ContactRef
  std::vector<physics::CollisionId> touching;  // the same
  std::set<std::string> serves;                // names of <sensor>s in whose place it measures
  Reading clean;                               // the latest, before `noise`; unused without
  Reading latest;
  std::size_t checked_fields = 0;   // fields of its readings
  PublishedReading published;       // the latest published, as snapshots have it
  Pose seen_from;                   // at its last sample, if its link moves
  std::uint64_t contacts_seen = 0;  // their revisions at its last sample
  std::uint64_t light_seen = 0;     // light's revision at its last sample
  KnownNoise known_noise;
  Nanoseconds cost = 0;  // CPU time that the meter counts
  std::string error;     // text of its exception; it is not called again

  /// Forgets the regions that it watches; they are found again with its next sample.
  void forget_regions();
  /// Makes its readings while nothing changes; null if they are the last one.
  std::shared_ptr<const LazyReading> lazy_reading() const;
};

/// A model in the world, with its devices and sensors.
struct LiveModel {
  std::shared_ptr<const desc::Model> desc;
  std::shared_ptr<const desc::Model> read;  // what its text says; edits change only `desc`
  Parts parts;
  std::vector<DeviceInstance> devices;
  std::vector<SensorInstance> sensors;
  std::vector<Storey> storeys;     // the world's when it came
  std::int64_t awake_at = 0;       // the last tick at whose end some of it was awake
  MoverIndex::Moment changed = 0;  // when it moved last; an awake one may move in the next tick
  std::uint32_t first_link = 0;    // index of its first link in Structure::links
  std::uint32_t first_joint = 0;
  std::uint32_t first_device = 0;
  std::uint32_t first_sensor = 0;
  std::uint32_t first_light = 0;
  bool is_light = false;  // it represents a light of the world's own
};

/// The numbers in Structure of the parts after the model.
struct Numbering {
  std::uint32_t link = 0;
  std::uint32_t joint = 0;
  std::uint32_t device = 0;
  std::uint32_t sensor = 0;
  std::uint32_t light = 0;
};
Numbering numbering_after(const LiveModel& live);

ModelInfo info_of(const desc::Model& model);  // `taken` is left out

/// Makes devices and sensors of a model that is not yet in the world. Throws Error for a
/// plug-in or parameter that is wrong; sensors without a plug-in, and joints that one of Angen's
/// own would drive, are added to `warnings`.
void make_instances(LiveModel& live, const std::vector<desc::Plugin>& world_plugins,
                    Catalog& catalog, std::vector<std::string>& warnings);

/// A sensor of `live`, on its link number `link`; shares its description. `only`: of a model's
/// own plug-in, the one of its library.
SensorInstance make_sensor(const LiveModel& live, std::uint32_t link,
                           std::shared_ptr<const desc::Sensor> shared, const std::string& name,
                           Catalog& catalog, std::vector<std::string>& warnings,
                           const Plugin* only = nullptr);

}  // namespace angen::sim
