#include "sdf/frames.h"

#include <algorithm>

#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"

namespace angen::load {

namespace {

// After the name of a joint that is called as a link; no name ends so.
constexpr char kOfJoint[] = " ";

std::string model_of(const std::string& scope) {
  return scope.empty() ? "" : scope.substr(0, scope.size() - 2);  // without "::"
}

std::string relative_to(const Element& element) {
  const Element* pose = element.child("pose");
  return pose == nullptr ? "" : pose->attribute_text("relative_to");
}

// The place to name where a pose is relative to something wrong.
const Source& place_of_pose(const Element& element) {
  return relative_to(element).empty() ? element.source : element.child("pose")->source;
}

bool is_frame(const Element& element) {
  return element.name == "link" || element.name == "joint" || element.name == "frame" ||
         element.name == "model";
}

}  // namespace

Frames::Frames(const Element& root) {
  Node& node = nodes_[""];
  node.element = &root;
  node.known = true;
  if (root.name == "model") node.attached = canonical_link(root, "");
  add_parts(root, "");
}

// Frames without attached_to are attached to their model's canonical link.
std::string Frames::canonical_link(const Element& model, const std::string& scope) const {
  const std::string given = model.attribute_text("canonical_link");
  if (!given.empty()) return scope + given;
  for (const Element& child : model.children) {
    if (child.name == "link") return scope + name_of(child);
  }
  for (const Element& child : model.children) {
    if (child.name != "model") continue;
    std::string nested = canonical_link(child, scope + name_of(child) + "::");
    if (!nested.empty()) return nested;
  }
  return "";
}

void Frames::add(const std::string& name, const Element& element, const std::string& scope,
                 const std::string& base, const std::string& attached) {
  Node node;
  node.element = &element;
  node.scope = scope;
  node.base = base;
  node.attached = attached;
  node.given = child_pose(element);
  const auto twin = nodes_.find(name);
  const bool is_joint = element.name == "joint";
  if (twin != nodes_.end() && twin->second.element->name == "joint" && !is_joint) {
    nodes_[name + kOfJoint] = std::move(twin->second);
  }
  nodes_[twin != nodes_.end() && is_joint ? name + kOfJoint : name] = std::move(node);
}

const Pose& Frames::joint_pose(const std::string& name) {
  return pose(nodes_.count(name + kOfJoint) != 0 ? name + kOfJoint : name);
}

void Frames::add_parts(const Element& model, const std::string& scope) {
  for (const Element& child : model.children) {
    if (!is_frame(child)) continue;
    const std::string name = scope + name_of(child);
    const std::string given = relative_to(child);
    std::string base = given.empty() ? "__model__" : given;
    std::string attached;
    if (child.name == "joint") {
      attached = child.child_text("child");
      if (given.empty()) base = attached;
    } else if (child.name == "frame") {
      attached = child.attribute_text("attached_to");
      if (given.empty() && !attached.empty()) base = attached;
      if (attached.empty()) attached = "__model__";
    } else if (child.name == "model") {
      const std::string inner = name + "::";
      add_parts(child, inner);
      add(name, child, scope, base, canonical_link(child, inner));
      const std::string placed = child.attribute_text("placement_frame");
      if (!placed.empty()) {
        Node& node = nodes_[name];
        node.given = node.given * Frames(child).pose(placed).inverse();
      }
      continue;
    }
    add(name, child, scope, base, attached);
  }
}

std::string Frames::key(const std::string& name, const std::string& scope,
                        const Element& what) const {
  if (name == "__model__" || (name == "world" && nodes_.at("").element->name == "world")) {
    return model_of(scope);
  }
  if (nodes_.count(scope + name) != 0) return scope + name;
  std::vector<std::string> known;
  for (const auto& [each, node] : nodes_) {
    if (!each.empty() && each.compare(0, scope.size(), scope) == 0) {
      known.push_back(each.substr(scope.size()));
    }
  }
  std::sort(known.begin(), known.end());
  throw Error(name == relative_to(what) ? place_of_pose(what) : what.source,
              tag_of(what) + " refers to an unknown frame '" + printable(name) + "'; known are " +
                  join_names(known));
}

const Pose& Frames::pose(const std::string& name) {
  std::vector<Node*> way;  // frames with unknown poses, each relative to the next
  Node* node = &nodes_.at(key(name, "", *nodes_.at("").element));
  while (!node->known) {
    if (node->visited) {
      throw Error(place_of_pose(*node->element),
                  tag_of(*node->element) + " has a pose that is relative to itself, by way of '" +
                      printable(node->base) + "'");
    }
    node->visited = true;
    way.push_back(node);
    node = &nodes_.at(key(node->base, node->scope, *node->element));
  }
  for (auto at = way.rbegin(); at != way.rend(); ++at) {
    (*at)->pose = node->pose * (*at)->given;
    (*at)->known = true;
    (*at)->visited = false;
    node = *at;
  }
  return node->pose;
}

Pose Frames::part_pose(const Element& part, const std::string& link, const std::string& scope) {
  Pose given = child_pose(part);
  const std::string frame = relative_to(part);
  if (frame.empty()) return given;
  return pose(link).inverse() * (pose(key(frame, scope, part)) * given);
}

const Quat& Frames::rotation(const std::string& frame, const std::string& scope,
                             const Element& what) {
  return pose(key(frame, scope, what)).rotation;
}

std::string Frames::link_of(const std::string& frame, const std::string& scope,
                            const Element& what) {
  if (frame == "world") return frame;
  std::string at = key(frame, scope, what);
  for (std::size_t steps = 0; steps <= nodes_.size(); ++steps) {
    const Node& node = nodes_.at(at);
    if (node.attached.empty() && node.element->name == "link") return at;
    const bool model = node.element->name == "model";  // its link's key is whole
    at = model ? node.attached : key(node.attached, node.scope, *node.element);
    if ((model && at.empty()) || nodes_.count(at) == 0) break;
  }
  throw Error(what.source,
              tag_of(what) + " refers to '" + printable(frame) + "', which is attached to no link");
}

}  // namespace angen::load
