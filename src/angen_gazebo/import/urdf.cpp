#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/text.h"
#include "document/dialect.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/gazebo.h"
#include "import/libsdformat.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

using Names = std::pair<std::string, std::string>;  // an element's tag, and its name

/// Where the parts of a robot are: each is looked up for each element that is made of it.
struct Index {
  std::map<Names, const Element*> own;    // elements of the robot
  std::map<Names, const Element*> parts;  // the robot's, and parts of its <gazebo> elements
  std::map<std::string, const Element*> joint_above;  // the joint above a link
  std::set<std::string> without_gravity;              // references of <gazebo> elements
};

Index index_of(const Element& robot) {
  Index index;
  for (const Element& part : robot.children) {
    index.own.insert({{part.name, name_of(part)}, &part});
    index.parts.insert({{part.name, name_of(part)}, &part});
    if (part.name == "joint")
      index.joint_above.insert({*part.child("child")->attribute("link"), &part});
    if (part.name != "gazebo") continue;
    for (const Element& child : part.children) {
      index.parts.insert({{child.name, name_of(child)}, &child});
    }
    const std::string* of = part.attribute("reference");
    const bool off = part.child("turnGravityOff") != nullptr || part.child("gravity") != nullptr;
    if (of != nullptr && off) index.without_gravity.insert(*of);
  }
  return index;
}

bool shares_names(const Index& index) {
  return std::any_of(index.own.begin(), index.own.end(), [&](const auto& part) {
    const auto& [tag, name] = part.first;
    return tag == "joint" && index.own.count({"link", name}) != 0;
  });
}

const Element* part_in(const std::map<Names, const Element*>& parts, const Names& names) {
  const auto found = parts.find(names);
  return found == parts.end() ? nullptr : found->second;
}

// BASE_fixed_joint_lump__LINK_collision, in a link that others were made one with.
const Element* lumped_part(const Index& index, const Element& made) {
  static const std::string kLump = "_fixed_joint_lump__";
  const std::string name = name_of(made);
  const std::size_t at = name.find(kLump);
  if (at == std::string::npos) return nullptr;
  const std::string part = name.substr(at + kLump.size());
  const std::size_t end = part.rfind("_" + made.name);
  const Element* link =
      end == std::string::npos ? nullptr : part_in(index.own, {"link", part.substr(0, end)});
  return link == nullptr ? nullptr : link->child(made.name);
}

// Elements that libsdformat made get the file and line of their originals.
void place(Element& made, const Element* original, const Index& index, const Source& around) {
  made.source = original == nullptr ? around : original->source;
  std::map<std::string, std::vector<const Element*>> given;
  if (original != nullptr) {
    for (const Element& child : original->children) given[child.name].push_back(&child);
  }
  std::map<std::string, std::size_t> seen;
  for (Element& child : made.children) {
    const std::string name = name_of(child);
    const Element* from = name.empty() ? nullptr : part_in(index.parts, {child.name, name});
    if (from == nullptr) from = lumped_part(index, child);
    if (from == nullptr) {
      const auto& twins = given[child.name];
      const std::size_t number = seen[child.name]++;
      if (number < twins.size()) from = twins[number];
    }
    place(child, from, index, made.source);
  }
}

// libsdformat drops <safety_controller>: its attributes become children of the joint's <axis>.
void keep_safety(const Index& index, Element& model) {
  for (Element& child : model.children) {
    if (child.name != "joint") continue;
    const Element* joint = part_in(index.own, {"joint", name_of(child)});
    const Element* safety = joint == nullptr ? nullptr : joint->child("safety_controller");
    Element* axis = find_child(child, "axis");
    if (safety == nullptr || axis == nullptr) continue;
    Element kept{kSafety, "", {}, {}, safety->source};
    for (const auto& [key, value] : safety->attributes) {
      kept.children.push_back({key, value, {}, {}, safety->source});
    }
    axis->children.push_back(std::move(kept));
  }
}

Pose pose_in(const Element* origin) {
  Pose pose;
  if (origin == nullptr) return pose;
  const auto vector = [&](const char* name) {
    const std::vector<double> v = numbers_in(origin->attribute_text(name)).values;
    return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3(Vec3::Zero());
  };
  const Vec3 rpy = vector("rpy");
  pose.position = vector("xyz");
  pose.rotation = from_rpy(rpy.x(), rpy.y(), rpy.z());
  return pose;
}

// The pose of a link in one of its ancestors, if only joints of the tree lie between them.
std::optional<Pose> lumped_pose(const Index& index, std::string link, const std::string& into) {
  Pose pose;
  while (link != into) {
    const auto found = index.joint_above.find(link);
    if (found == index.joint_above.end()) return std::nullopt;
    const Element& joint = *found->second;
    pose = pose_in(joint.child("origin")) * pose;
    link = *joint.child("parent")->attribute("link");
  }
  return pose;
}

// libsdformat names the link that a plug-in's body is lumped into, but gets the offset to it wrong
// where that takes several joints.
void fix_offset(const Element& given, const Index& index, Element& made) {
  const std::string body = given.child_text("bodyName");
  const std::string into = made.child_text("bodyName");
  if (body.empty() || body == into) return;
  const std::optional<Pose> lumped = lumped_pose(index, body, into);
  if (!lumped) return;
  const Element offset{
      "origin",
      "",
      {{"xyz", given.child_text("xyzOffset")}, {"rpy", given.child_text("rpyOffset")}}};
  const std::string text = pose_text(*lumped * pose_in(&offset));
  const std::vector<double> v = numbers_in(text).values;
  const auto three = [&](std::size_t from) {
    return number_text(v[from]) + " " + number_text(v[from + 1]) + " " + number_text(v[from + 2]);
  };
  set_child(made, "xyzOffset", three(0));
  set_child(made, "rpyOffset", three(3));
}

// Plug-ins may share a name, of which libsdformat would keep one: each later one gets a name of its
// own. Returns the given names by those.
std::map<std::string, std::string> name_plugins_apart(Element& robot) {
  std::map<std::string, std::string> given;
  for (Element& extension : robot.children) {
    if (extension.name != "gazebo") continue;
    for (Element& plugin : extension.children) {
      if (plugin.name != "plugin") continue;
      const std::string name = name_of(plugin);
      std::string own = name;
      for (int twin = 2; !given.emplace(own, name).second; ++twin) {
        own = name + " " + std::to_string(twin);
      }
      if (own != name) set_attribute(plugin, "name", own);
    }
  }
  return given;
}

// The plug-ins of a robot keep their names and lines, and sit where they should.
void fix_plugins(const Element& robot, const Index& index,
                 const std::map<std::string, std::string>& names, Element& model) {
  std::map<std::string, const Element*> all;  // by name
  for (const Element& extension : robot.children) {
    if (extension.name != "gazebo") continue;
    for (const Element& given : extension.children) {
      if (given.name == "plugin") all.emplace(name_of(given), &given);
    }
  }
  for (Element& made : model.children) {
    const auto found = made.name == "plugin" ? all.find(name_of(made)) : all.end();
    if (found == all.end()) continue;
    set_source(made, found->second->source);
    fix_offset(*found->second, index, made);
    if (made.attribute("name") != nullptr) set_attribute(made, "name", names.at(found->first));
  }
}

// libsdformat takes the gravity of a whole robot if a sensor that is fixed to it has none.
void keep_gravity(const Index& index, Element& model) {
  for (Element& link : model.children) {
    if (link.name != "link" || index.without_gravity.count(name_of(link)) != 0) continue;
    remove_children(link, "gravity");
  }
}

// The joints of a <transmission>, with their hardware interfaces, which may stand in its actuators.
std::vector<std::pair<std::string, std::string>> driven_by(const Element& transmission) {
  std::string of_actuator;
  for (const Element& child : transmission.children) {
    if (child.name == "actuator") of_actuator = child.child_text("hardwareInterface");
  }
  std::vector<std::pair<std::string, std::string>> driven;
  for (const Element& joint : transmission.children) {
    if (joint.name != "joint" || name_of(joint).empty()) continue;
    const std::string own = joint.child_text("hardwareInterface");
    driven.emplace_back(name_of(joint), own.empty() ? of_actuator : own);
  }
  return driven;
}

// libsdformat drops transmissions: gazebo_ros_control's <plugin> gets them.
void keep_transmissions(const Element& robot, Element& model) {
  std::vector<Element> all;
  for (const Element& transmission : robot.children) {
    if (transmission.name != "transmission") continue;
    for (const auto& [joint, interface] : driven_by(transmission)) {
      all.push_back({"transmission", "", {}, {}, transmission.source});
      all.back().children = {Element{"joint", joint, {}, {}, transmission.source},
                             Element{"hardwareInterface", interface, {}, {}, transmission.source}};
    }
  }
  std::size_t kept = 0;
  for (Element& plugin : model.children) {
    if (plugin.name != "plugin") continue;
    if (plugin.attribute_text("filename") != "libgazebo_ros_control.so") continue;
    kept += all.size();
    check_model_size(kept, robot.source);
    plugin.children.insert(plugin.children.end(), all.begin(), all.end());
  }
}

// libsdformat would make one link of those that a force-torque sensor measures between.
std::string with_measured_joints(const Element& robot, const Index& index) {
  Element kept = robot;
  for (const Element& extension : robot.children) {
    const Element* plugin = extension.name == "gazebo" ? extension.child("plugin") : nullptr;
    if (plugin == nullptr || plugin->attribute_text("filename") != kFtSensor) continue;
    const std::string name = measured_joint(*plugin, name_of(robot));
    const Element* joint = part_in(index.own, {"joint", name});
    if (joint == nullptr || joint->attribute_text("type") != "fixed") continue;
    Element preserve = Element{"gazebo", "", {}, {}, joint->source};
    preserve.attributes = {{"reference", name}};
    preserve.children = {Element{"preserveFixedJoint", "true", {}, {}, joint->source}};
    kept.children.push_back(std::move(preserve));
  }
  return print_xml(kept);
}

// Joints that a plug-in makes follow, or that have a transmission.
std::set<std::string> driven_joints(const Element& robot, const Element& model) {
  std::set<std::string> joints;
  for (const Element& plugin : model.children) {
    if (plugin.name == "plugin") joints.insert(plugin.child_text("mimicJoint"));
  }
  for (const Element& transmission : robot.children) {
    if (transmission.name != "transmission") continue;
    for (const auto& [joint, interface] : driven_by(transmission)) joints.insert(joint);
  }
  return joints;
}

// libsdformat drops <mimic>: a plug-in replaces it.
void keep_mimics(const Element& robot, Element& model) {
  const std::set<std::string> driven = driven_joints(robot, model);
  for (const Element& joint : robot.children) {
    const Element* mimic = joint.name == "joint" ? joint.child("mimic") : nullptr;
    const std::string* leader = mimic == nullptr ? nullptr : mimic->attribute("joint");
    if (leader == nullptr || driven.count(name_of(joint)) != 0) continue;
    Element plugin = Element{"plugin", "", {}, {}, mimic->source};
    plugin.attributes = {{"name", name_of(joint) + "_mimic"},
                         {"filename", "libroboticsgroup_gazebo_mimic_joint_plugin.so"}};
    plugin.children = {Element{"joint", *leader, {}, {}, mimic->source},
                       Element{"mimicJoint", name_of(joint), {}, {}, mimic->source}};
    for (const char* key : {"multiplier", "offset"}) {
      if (const std::string* value = mimic->attribute(key)) {
        plugin.children.push_back({key, *value, {}, {}, mimic->source});
      }
    }
    model.children.push_back(std::move(plugin));
  }
}

// The conversion places a link at its joint. If a link has the joint's name too, that name means
// the link: then this one is placed where its joint is.
void place_links_of_shared_names(const Index& index, Element& model) {
  for (Element& link : model.children) {
    Element* pose = link.name == "link" ? find_child(link, "pose") : nullptr;
    const std::string* at = pose == nullptr ? nullptr : pose->attribute("relative_to");
    if (at == nullptr || index.own.count({"link", *at}) == 0) continue;
    for (const Element& joint : model.children) {
      if (joint.name != "joint" || name_of(joint) != *at) continue;
      if (const Element* place = joint.child("pose")) *pose = Element(*place);
      break;
    }
  }
}

// The elements that the conversion writes, and those of <gazebo> elements.
std::set<std::string> names_in(const Element& robot) {
  const std::vector<std::string> words = words_in(
      "model link joint pose frame inertial mass inertia ixx ixy ixz iyy iyz izz collision visual "
      "sensor geometry box size cylinder radius length sphere mesh uri scale surface contact "
      "friction bounce ode kp kd mu mu2 fdir1 material script name axis axis2 xyz limit lower "
      "upper effort velocity dynamics damping spring_reference spring_stiffness parent child "
      "plugin static gravity self_collide max_vel min_depth diffuse ambient specular emissive "
      "use_parent_model_frame physics provide_feedback implicit_spring_damper cfm_damping "
      "fudge_factor torsional coefficient");
  std::set<std::string> names(words.begin(), words.end());
  collect_names(robot, names);
  return names;
}

}  // namespace

Element Gazebo::convert_urdf(Element robot, Session& session) const {
  if (!session.read_without_errors({&robot}, [&] { check_robot(robot); })) {
    throw Error(session.set_aside.back());
  }
  const std::map<std::string, std::string> names = name_plugins_apart(robot);
  const SilenceConsole silence;
  const sdf::SDFPtr document = empty_document(names_in(robot));
  sdf::Errors errors;
  const Index index = index_of(robot);
  const std::string kept = with_measured_joints(robot, index);
  if (!sdf::readString(kept, document, errors) || !errors.empty()) {
    const std::string why = errors.empty() ? silence.messages() : errors.front().Message();
    throw Error(robot.source, "this URDF cannot be converted to SDF: " + why.substr(0, 300));
  }
  Element root = parse_xml(document->Root()->ToString(""), robot.source.file);
  place(root, &robot, index, robot.source);
  if (Element* model = find_child(root, "model")) {
    keep_safety(index, *model);
    fix_plugins(robot, index, names, *model);
    keep_gravity(index, *model);
    keep_transmissions(robot, *model);
    keep_mimics(robot, *model);
    if (shares_names(index)) {  // SDF gives joints no names of their own
      place_links_of_shared_names(index, *model);
      set_attribute(*model, kStrict, "false");
    }
  }
  return root;
}

}  // namespace angen::load
