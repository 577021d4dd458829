// libdoor_world_plugin.so
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "devices/door.h"
#include "devices/part_names.h"
#include "plugin/registration.h"

namespace angen::devices {

namespace {

const char* const kOwnJoints[] = {"hinge", "sash", "front"};

bool limited(double lower, double upper) { return lower < upper && upper - lower < 2.0 * M_PI; }

bool turns_or_slides(const ModelInfo::Joint& joint) {
  return joint.type == "revolute" || joint.type == "prismatic";
}

// A leaf on a frame that is fixed to the world and named as a door, window or cabinet: an arm's
// first joint may turn as a door does.
bool is_framed(const ModelInfo::Joint& joint, const ModelInfo& model, const LeafKind& leaf) {
  if (!leaf.any_joint || joint.type != "revolute" || !joint.on_world || !joint.vertical()) {
    return false;
  }
  const bool is_own =
      std::find(std::begin(kOwnJoints), std::end(kOwnJoints), joint.name) != std::end(kOwnJoints);
  if (is_own || !limited(joint.lower, joint.upper)) return false;
  for (const std::string& name : {joint.name, joint.child, model.name}) {
    if (name.find(leaf.kind) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

LeafPlugin::LeafPlugin(const LeafKind& leaf)
    : leaf_(leaf), kind_(leaf.kind, std::string("A ") + leaf.kind + ".") {
  kind_.passage(leaf.passage)
      .example(leaf.example)
      .command_topic(leaf.topic)
      .verb("Open", "moves to its open_position")
      .verb("Close", "moves to its closed_position")
      .verb("OpenByHand", "a hand turns its handle and opens it, with at most 60 N at its edge")
      .verb("CloseByHand", "a hand shuts it, with at most 60 N at its edge")
      .verb("Unlatch", "turns its handle: for 3 s its latch does not hold")
      .verb("Set", "radians", "rad", {}, "moves to this angle of its hinge")
      .choice("mode", {std::begin(kLeafModes), std::end(kLeafModes)},
              "AJAR: at rest between shut and open; BLOCKED: commanded, but something holds it")
      .shown()
      .number("position", "rad", "of its hinge, 0 shut, negative open")
      .shown(2)
      .number("velocity", "rad/s", "of its hinge")
      .number("target", "rad", "target angle")
      .number("gap", "m", "free width of the opening")
      .number("width", "m", "of the leaf")
      .number("height", "m", "of the opening")
      .numbers("hinge", "m", "where its hinge is, in the world")
      .number("shut", "rad", "direction from the hinge to the edge of the shut leaf, in the world")
      .number("opens", "rad", "from shut to open, counterclockwise from above");
  for (const char* model : leaf.models) kind_.model(model);
}

std::string LeafPlugin::needs() const {
  std::string needed = std::string("a revolute joint ") + leaf_.joint + " with parent base";
  if (leaf_.any_joint) {
    needed +=
        ", one about a vertical axis with limits whose parent is the world, or fixed to it where "
        "a name says door, or one that <joint> names";
  }
  return needed;
}

bool LeafPlugin::is_leaf(const ModelInfo::Joint& joint) const {
  if (joint.name == leaf_.joint && joint.parent == "base") return turns_or_slides(joint);
  if (joint.type != "revolute") return false;
  const bool is_others =
      joint.name != leaf_.joint &&
      std::find(std::begin(kOwnJoints), std::end(kOwnJoints), joint.name) != std::end(kOwnJoints);
  return leaf_.any_joint && !is_others && joint.parent == "world" && joint.on_world &&
         joint.vertical() && limited(joint.lower, joint.upper);
}

std::vector<const ModelInfo::Joint*> LeafPlugin::leaves(const ModelInfo& model,
                                                        Params& params) const {
  std::vector<std::string> named;
  if (leaf_.any_joint) named = params.texts("joint", "", kLeafJointDoc);
  std::vector<const ModelInfo::Joint*> found;
  for (const ModelInfo::Joint& joint : model.joints) {
    const bool is_named = std::find(named.begin(), named.end(), joint.name) != named.end();
    if (is_named && !turns_or_slides(joint)) {
      throw params.error("joint", "joint '" + joint.name + "' is " + joint.type +
                                      "; that of a leaf is revolute or prismatic");
    }
    const bool is_found = is_leaf(joint) || is_framed(joint, model, leaf_);
    if ((is_named || is_found) && !joint.taken) found.push_back(&joint);
  }
  return found;
}

std::vector<Mount> LeafPlugin::mounts(const ModelInfo& model, Params& params) const {
  const std::vector<const ModelInfo::Joint*> found = leaves(model, params);
  std::vector<Mount> mounts;
  mounts.reserve(found.size());
  for (const ModelInfo::Joint* leaf : found) {
    mounts.push_back({name_of(*leaf, model, found.size() == 1), leaf->name});
  }
  return mounts;
}

// The model's only leaf is named after it, if its name has the kind; others after their links.
std::string LeafPlugin::name_of(const ModelInfo::Joint& leaf, const ModelInfo& model,
                                bool only) const {
  std::string of_model = command_name(model, kind_.name);
  const bool is_own = leaf.name == leaf_.joint && leaf.parent == "base";
  if (only && (is_own || model.name.find(kind_.name) != std::string::npos)) return of_model;
  for (const std::string& part : {leaf.child, leaf.name}) {
    std::string name = leaf_name(part, kind_.name, floor_at(model.storeys, leaf.height));
    if (!name.empty()) return name;
  }
  return only ? of_model : leaf.name;
}

}  // namespace angen::devices

ANGEN_REGISTER_PLUGIN(angen::devices::DoorPlugin)
ANGEN_REGISTER_PLUGIN(angen::devices::WindowPlugin)
ANGEN_REGISTER_PLUGIN(angen::devices::CabinetPlugin)
