#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <utility>
#include <vector>

#include "ros/changes.h"
#include "ros/lazy_publisher.h"
#include "ros/pacer.h"
#include "rviz/marker_shapes.h"
#include "rviz/overlays.h"
#include "sim/snapshot.h"

namespace angen::node {

/// A marker, and the limb that it is a part of, in Anatomy::limbs; -1: none.
struct LinkDrawing : Drawing {
  int limb = -1;
};

/// Markers of one link.
struct DrawnLink {
  std::vector<LinkDrawing> drawings;
  sim::LimbPoses limbs;
};

/// Markers of one model, with the groups (their namespaces) and ids that they keep until the model
/// is deleted.
struct DrawnModel {
  std::vector<DrawnLink> links;  // indexed like desc::Model::links
};

/// /angen/markers: the whole world for each new subscriber, then only changes, at most 15
/// times a second of wall time. Nothing is built or updated without a subscriber.
class Markers {
 public:
  Markers(ros::NodeHandle& node, Readings& readings);

  void publish(const sim::Snapshot& snapshot, Pacer::Clock::time_point now);

 private:
  using Array = visualization_msgs::MarkerArray;

  void on_structure(const sim::Snapshot& snapshot);
  void draw_models(const sim::Structure& structure, const Changes& changes);
  void mark(std::uint32_t link);
  void mark_limbs(const sim::Snapshot& snapshot);
  void put_link(const sim::Snapshot& snapshot, std::uint32_t link, Array& array);
  Array collect(const sim::Snapshot& snapshot, bool all);

  LazyPublisher publisher_;
  std::shared_ptr<const sim::Structure> structure_;  // the structure that is drawn
  std::int32_t next_id_ = 0;
  std::vector<DrawnModel> models_;                               // indexed like Structure::models
  std::vector<DrawnLink*> links_;                                // indexed like Structure::links
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bodies_;  // devices and links with limbs
  Overlays overlays_;
  Array gone_;                          // to be published as deleted
  std::vector<std::uint32_t> changed_;  // links, each once
  std::vector<bool> marked_;            // indexed like Structure::links
  std::uint64_t joined_ = 0;
  Pacer::Clock::time_point next_send_{};
};

}  // namespace angen::node
