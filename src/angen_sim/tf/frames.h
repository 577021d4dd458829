#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "desc/world.h"
#include "ros/changes.h"
#include "ros/robots.h"
#include "ros/ros_kind.h"
#include "sim/snapshot.h"

/// The tree of coordinate frames, worked out once for each structure.
namespace angen::node {

struct FixedFrame {
  std::string parent;
  std::string child;
  Pose pose;  // the child in the parent

  bool operator==(const FixedFrame& o) const {
    return child == o.child && parent == o.parent && pose == o.pose;
  }
};

struct MovingFrame {
  std::string parent;
  std::string child;
  std::uint32_t link = 0;                    // Structure::links
  std::optional<std::uint32_t> parent_link;  // none: the world
};

/// The frames of a model's links, which are counted within the model. Links that fixed joints hold
/// together hang on the first of them; a robot's hang on its base, whose own place under its
/// odometry frame is its odometry's business, not this tree's.
struct ModelFrames {
  struct Standing {
    std::size_t fixed = 0;  // below `fixed`; where it is in the world is the link's pose
    std::uint32_t link = 0;
  };

  std::string base_frame;  // a robot's, else empty
  std::uint32_t base = 0;  // its link
  std::vector<std::string> links;
  std::vector<FixedFrame> fixed;
  std::vector<Standing> standing;
  std::vector<MovingFrame> moving;
  std::vector<std::int32_t> moved_by;  // for each link the index in `moving` that carries it, or -1
};

/// `base_frame` is empty if the model is not a robot.
ModelFrames frames_of(const desc::Model& model, const std::string& base_frame, std::uint32_t base);

struct FrameTree {
  sim::SharedArray<FixedFrame> fixed;  // frames of links
  std::vector<FixedFrame> odometry;
  sim::SharedArray<FixedFrame> mounts;  // frames of sensors, on their links
  sim::SharedArray<MovingFrame> moving;
  sim::SharedArray<std::string> sensors;  // frame of each sensor, as Structure::sensors
  sim::SharedArray<std::string> bases;    // the frame whose odometry or truth it is, or empty
  sim::SharedArray<std::int32_t>
      moved_by;  // for each link the index in `moving` that carries it, or -1

  std::size_t fixed_count() const { return fixed.size() + odometry.size() + mounts.size(); }
};

/// Makes the tree of each structure, which shares unchanged parts with the tree before.
/// `world` is the root. Odometry frames are fixed in the world, unless a localization places them.
class FrameMaker {
 public:
  /// The tf_prefix of robots made for Gazebo in a namespace.
  using PrefixIn = std::function<std::string(const std::string& space)>;

  explicit FrameMaker(bool odometry_in_world = true, PrefixIn prefix_in = nullptr)
      : odometry_in_world_(odometry_in_world), prefix_in_(std::move(prefix_in)) {}

  /// `changes`: since the structure of the last call.
  std::shared_ptr<const FrameTree> make(const sim::Snapshot& snapshot,
                                        const std::vector<Robot>& robots, const Changes& changes);

 private:
  /// The decision about a sensor's frame.
  struct Mounted {
    std::uint32_t mount = 0;   // how many of FrameTree::mounts came before it
    bool takes_frame = false;  // no other sensor has that frame
    bool is_odometry = false;
  };

  /// Returns how many of the first models have their frames as before.
  std::size_t keep_models(const sim::Structure& structure, const std::vector<Robot>& robots,
                          const Changes& changes);
  void drop(const std::shared_ptr<const ModelFrames>& model);
  void add_links(const sim::Snapshot& snapshot, std::size_t kept, FrameTree& tree) const;
  void add_odometry(const sim::Structure& structure, const std::vector<Robot>& robots,
                    FrameTree& tree) const;
  std::size_t keep_sensors(const sim::Structure& structure, std::size_t models,
                           const Changes& changes, FrameTree& tree);
  void add_sensor(const sim::Structure& structure, std::uint32_t number, const Robot* owner,
                  FrameTree& tree);
  std::string own_frame(const sim::SensorEntry& sensor, const RosKind& kind, const Robot* owner,
                        const std::string& link_frame, bool& is_taken);
  bool take(const std::string& frame);
  const std::string& frame_of(const sim::LinkEntry& link) const {
    return models_[link.model]->links[link.link];
  }

  std::string prefix_of(const desc::Model& model) const;

  bool odometry_in_world_;
  PrefixIn prefix_in_;
  std::shared_ptr<const FrameTree> tree_;                   // the last one
  std::vector<std::shared_ptr<const ModelFrames>> models_;  // indexed like Structure::models
  std::vector<std::string> prefixes_;                       // each model's, when it came
  std::unordered_map<std::string, int> link_frames_;        // how many links have one
  std::vector<Mounted> mounted_;                            // indexed like Structure::sensors
  std::unordered_set<std::string> sensor_frames_;           // besides those of links
  bool other_names_ = false;  // a sensor's frame has another name than it would have alone
};

}  // namespace angen::node
