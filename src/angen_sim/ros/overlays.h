#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/marker_shapes.h"
#include "sim/snapshot.h"

namespace angen::node {

/// Markers that show a value: a ball for each lamp, rays for each ray sensor, a caption for others.
class Overlays {
 public:
  using Array = visualization_msgs::MarkerArray;

  /// Makes overlays of what exists now; what no longer exists is added to `gone`, to be deleted.
  void on_structure(const sim::Snapshot& snapshot, std::int32_t& next_id, Array& gone);

  /// Appends what looks different than when it was appended last; with `all` everything.
  void append(const sim::Snapshot& snapshot, bool all, Array& array);

 private:
  struct Overlay {
    visualization_msgs::Marker marker;
    std::uint32_t index = 0;  // in Structure::lights, ::sensors or ::devices
    bool of_device = false;
    std::uint32_t link = UINT32_MAX;  // in Structure::links; none for a world light
    Pose offset;
    Pose pose;                            // as appended last
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
  /// Whether what it shows has changed since the last call.
  static bool is_new(const sim::Snapshot& snapshot, Overlay& overlay);
  bool relight(const sim::Snapshot& snapshot, Overlay& lamp) const;
  bool redraw(const sim::Snapshot& snapshot, Overlay& beams) const;
  bool rewrite(const sim::Snapshot& snapshot, Overlay& caption) const;

  Named lamps_;
  Named beams_;
  Named captions_;
};

}  // namespace angen::node
