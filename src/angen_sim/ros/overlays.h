#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/marker_shapes.h"
#include "ros/rooms.h"
#include "sim/snapshot.h"

namespace angen::node {

/// Markers that show a value or a name: a ball for each lamp and its light in its room, rays for
/// each ray sensor, a caption for others, and labels of rooms, lamps and doors.
class Overlays {
 public:
  using Array = visualization_msgs::MarkerArray;

  /// Makes overlays of what exists now; what no longer exists is added to `gone`, to be deleted.
  void on_structure(const sim::Snapshot& snapshot, std::int32_t& next_id, Array& gone);

  /// Appends what differs from when it was appended last; with `all` everything.
  void append(const sim::Snapshot& snapshot, bool all, Array& array);

 private:
  struct Overlay {
    visualization_msgs::Marker marker;    // as appended last; without a namespace: not shown
    std::string storey;                   // " 0", or empty; see storey_suffix
    std::shared_ptr<const void> subject;  // the description of what it shows; none: the world's
    std::uint32_t index = 0;              // in Structure::lights, ::sensors or ::devices
    bool of_device = false;
    std::uint32_t link = UINT32_MAX;  // in Structure::links; none: it is still
    Pose offset;
    Pose pose;                            // as appended last
    bool drawn = false;                   // since the structure changed
    double level = -1.0;                  // of a lamp, as appended last
    std::shared_ptr<const Reading> last;  // compared last
    Nanoseconds stamp = 0;                // of what was made in its place then
    std::vector<double> ranges;           // m, as appended last
    bool fired = false;
  };
  using Named = std::map<std::string, Overlay>;

  void add_lamp(const sim::Structure& structure, std::uint32_t light);
  void add_sensor(const sim::Structure& structure, std::uint32_t sensor);
  void add_device(const sim::Structure& structure, std::uint32_t device);
  void add_label(const sim::Structure& structure, std::uint32_t device);
  void add_room_labels();
  /// Gives overlays that existed before their markers back, and those of the same subject all that
  /// was appended last; others get an id, or are `gone`.
  static void keep_markers(Named& old, Named& now, std::int32_t& next_id, Array& gone);
  /// What was appended last stays so. Where an overlay is, and in which structure, is `now`.
  static void keep_drawn(Overlay& old, Overlay& now);
  /// What an overlay shows from now on; in another namespace than before, or nowhere if that is
  /// empty, what it showed is deleted.
  void show(Overlay& overlay, visualization_msgs::Marker marker, const std::string& group);
  /// Whether the reading or state that it shows has changed since the last call.
  static bool is_new(const sim::Snapshot& snapshot, Overlay& overlay);
  // Each returns whether the marker has changed.
  bool relight(const sim::Snapshot& snapshot, Overlay& lamp);
  bool glow(const sim::Snapshot& snapshot, Overlay& lamp);
  bool redraw(const sim::Snapshot& snapshot, Overlay& beams);
  bool rewrite(const sim::Snapshot& snapshot, Overlay& caption);

  std::vector<Room> rooms_;
  Named lamps_;
  Named beams_;
  Named captions_;
  Named glows_;
  Named labels_;
  std::vector<visualization_msgs::Marker> stale_;  // to be deleted
};

}  // namespace angen::node
