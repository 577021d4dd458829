#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "desc/world.h"

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

}  // namespace angen::node
