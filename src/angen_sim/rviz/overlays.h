#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/changes.h"
#include "ros/readings.h"
#include "rviz/glow.h"
#include "rviz/marker_shapes.h"
#include "sim/snapshot.h"

namespace angen::node {

/// Markers that show a value or a name: a ball for each lamp and its light in its room, rays for
/// each ray sensor, a caption for others, and labels of rooms, lamps and doors.
class Overlays {
 public:
  using Array = visualization_msgs::MarkerArray;

  /// `next_id` is that of the next marker.
  Overlays(std::int32_t& next_id, Readings& readings) : next_id_(next_id), readings_(readings) {}

  /// Makes overlays of entries that are new since the last call; those of removed entries are
  /// added to `removed`, to be deleted.
  void on_structure(const sim::Structure& structure, const Changes& changes, Array& removed);

  /// Appends markers that differ from the last call's; with `all` every marker.
  void append(const sim::Snapshot& snapshot, bool all, Array& array);

 private:
  enum class Of { kNothing, kLight, kSensor, kDevice };
  struct Overlay {
    visualization_msgs::Marker marker;  // last appended; without a namespace: not shown
    std::string storey;                 // " 0", or empty; see storey_suffix; " south 0" of a wall
    std::uint32_t index = UINT32_MAX;   // in Structure::lights, ::sensors or ::devices
    Of of = Of::kNothing;
    std::uint32_t link = UINT32_MAX;  // in Structure::links; none: it is still
    Pose offset;
    Pose pose;                            // last appended
    bool drawn = false;                   // it was appended
    double level = -1.0;                  // a lamp's, last appended
    std::vector<LitFace> faces;           // faces of its room
    std::shared_ptr<const Reading> last;  // compared last
    Nanoseconds stamp = 0;                // stamp of the reading computed for it then
    std::vector<double> ranges;           // m, as appended last
    double tilt = 0.0;                    // rad, as well
    bool fired = false;
  };
  using Named = std::map<std::string, Overlay>;

  Overlay& put(Named& all, const std::string& name, Overlay overlay);
  void add_lamp(const sim::Structure& structure, std::uint32_t light);
  void add_glow(const sim::Structure& structure, std::uint32_t light);
  void add_sensor(const sim::Structure& structure, std::uint32_t sensor);
  void add_device(const sim::Structure& structure, std::uint32_t device);
  void add_label(const sim::Structure& structure, std::uint32_t device);
  void add_room_labels();
  /// Updates the indices of overlays; those of removed entries are added to `removed`.
  static void keep(Named& all, const Changes& changes, Array& removed);
  static void drop(Named& all, Array& removed);
  /// Sets the marker of an overlay. With another namespace than before, or an empty one,
  /// the marker before is deleted.
  void show(Overlay& overlay, visualization_msgs::Marker marker, const std::string& group);
  /// Whether the reading or state that it shows has changed since the last call.
  static bool is_new(const sim::Snapshot& snapshot, Overlay& overlay);
  // Each returns whether the marker has changed.
  bool relight(const sim::Snapshot& snapshot, Overlay& lamp);
  bool glow(const sim::Snapshot& snapshot, Overlay& lamp);
  bool redraw(const sim::Snapshot& snapshot, Overlay& beams);
  bool rewrite(const sim::Snapshot& snapshot, Overlay& caption);

  std::int32_t& next_id_;
  Readings& readings_;
  std::shared_ptr<const DerivedHome> home_;  // whose rooms are shown
  Named lamps_;
  Named beams_;
  Named captions_;
  Named glows_;
  Named labels_;
  Named room_labels_;
  std::vector<visualization_msgs::Marker> stale_;  // to be deleted
};

}  // namespace angen::node
