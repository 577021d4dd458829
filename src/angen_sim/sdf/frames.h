#pragma once

#include <string>
#include <unordered_map>

#include "core/element.h"
#include "core/pose.h"

namespace angen::load {

/// The frames of a <model>, nested ones included, or of a <world>, and their poses, by SDF
/// 1.9's rules: <pose relative_to>, <frame attached_to>, placement_frame, canonical_link. Each is
/// computed once, so the cost of a model is linear in its size.
class Frames {
 public:
  /// `root` must outlive it. Names must have been checked.
  explicit Frames(const Element& root);

  /// The pose of the link, joint, frame or model `name` ("a::b" in a nested model) in the root's.
  /// Throws Error if it, or a frame below it, does not exist or is relative to itself.
  const Pose& pose(const std::string& name);
  /// The pose of a joint, which may be called as a link is.
  const Pose& joint_pose(const std::string& name);

  /// The pose of a part of a link (or of the root, with link "") in that link. `scope` is the
  /// prefix of the model that the link is in, such as "a::".
  Pose part_pose(const Element& part, const std::string& link, const std::string& scope);

  /// The rotation of a frame that `what` names, in the root's frame.
  const Quat& rotation(const std::string& frame, const std::string& scope, const Element& what);

  /// The link that a link, joint, frame or model is attached to, with its prefix. "world" for the
  /// world.
  std::string link_of(const std::string& frame, const std::string& scope, const Element& what);

 private:
  struct Node {
    const Element* element = nullptr;
    std::string scope;
    std::string base;      // the frame that `given` is relative to
    std::string attached;  // "" for a link
    Pose given;
    Pose pose;  // in the root's frame, once it is known
    bool known = false;
    bool visited = false;  // on the way to its base
  };

  void add_parts(const Element& model, const std::string& scope);
  void add(const std::string& name, const Element& element, const std::string& scope,
           const std::string& base, const std::string& attached);
  /// The key of the frame that `name` means in a scope; throws Error at `what`.
  std::string key(const std::string& name, const std::string& scope, const Element& what) const;
  std::string canonical_link(const Element& model, const std::string& scope) const;

  std::unordered_map<std::string, Node> nodes_;  // by name with its prefix; "" is the root
};

}  // namespace angen::load
