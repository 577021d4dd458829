#include "import/urdf.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/gazebo_model.h"
#include "import/libsdformat.h"
#include "import/urdf_check.h"

namespace angen::load {

namespace {

const Element* nth_child(const Element& parent, const std::string& name, std::size_t number) {
  for (const Element& child : parent.children) {
    if (child.name == name && number-- == 0) return &child;
  }
  return nullptr;
}

// A link or joint of the robot, or of a <gazebo> element.
const Element* named_part(const Element& robot, const Element& made) {
  const auto is_it = [&](const Element& given) {
    return given.name == made.name && name_of(given) == name_of(made);
  };
  for (const Element& part : robot.children) {
    if (is_it(part)) return &part;
    if (part.name != "gazebo") continue;
    for (const Element& child : part.children) {
      if (is_it(child)) return &child;
    }
  }
  return nullptr;
}

// BASE_fixed_joint_lump__LINK_collision, in a link that others were made one with.
const Element* lumped_part(const Element& robot, const Element& made) {
  static const std::string kLump = "_fixed_joint_lump__";
  const std::string name = name_of(made);
  const std::size_t at = name.find(kLump);
  if (at == std::string::npos) return nullptr;
  const std::string part = name.substr(at + kLump.size());
  for (const Element& link : robot.children) {
    const std::string start = name_of(link) + "_" + made.name;
    if (link.name == "link" && part.rfind(start, 0) == 0) return nth_child(link, made.name, 0);
  }
  return nullptr;
}

// Elements that libsdformat made get the file and line of their originals.
void place(Element& made, const Element* original, const Element& robot, const Source& around) {
  made.source = original == nullptr ? around : original->source;
  std::map<std::string, std::size_t> seen;
  for (Element& child : made.children) {
    const Element* from = name_of(child).empty() ? nullptr : named_part(robot, child);
    if (from == nullptr) from = lumped_part(robot, child);
    if (from == nullptr && original != nullptr) {
      from = nth_child(*original, child.name, seen[child.name]++);
    }
    place(child, from, robot, made.source);
  }
}

// libsdformat drops <safety_controller>: its attributes become children of the joint's <axis>.
void keep_safety(const Element& joint, Element& root) {
  const Element* safety = joint.child("safety_controller");
  Element* model = find_child(root, "model");
  if (safety == nullptr || model == nullptr) return;
  for (Element& child : model->children) {
    Element* axis = find_child(child, "axis");
    if (child.name != "joint" || name_of(child) != name_of(joint) || axis == nullptr) continue;
    Element kept;
    kept.name = kSafety;
    kept.source = safety->source;
    for (const auto& [key, value] : safety->attributes) {
      Element number;
      number.name = key;
      number.text = value;
      number.source = safety->source;
      kept.children.push_back(std::move(number));
    }
    axis->children.push_back(std::move(kept));
  }
}

Pose pose_in(const Element* origin) {
  Pose pose;
  if (origin == nullptr) return pose;
  const auto vector = [&](const char* name) {
    const std::string* text = origin->attribute(name);
    const std::vector<double> v =
        text == nullptr ? std::vector<double>{} : numbers_in(*text).values;
    return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3(Vec3::Zero());
  };
  const Vec3 rpy = vector("rpy");
  pose.position = vector("xyz");
  pose.rotation = from_rpy(rpy.x(), rpy.y(), rpy.z());
  return pose;
}

// The pose of a link in one of its ancestors, if only joints of the tree lie between them.
std::optional<Pose> lumped_pose(const Element& robot, std::string link, const std::string& into) {
  Pose pose;
  for (std::size_t i = 0; i <= robot.children.size() && link != into; ++i) {
    const auto joint =
        std::find_if(robot.children.begin(), robot.children.end(), [&](const Element& each) {
          const Element* child = each.child("child");
          return each.name == "joint" && child != nullptr && *child->attribute("link") == link;
        });
    if (joint == robot.children.end()) return std::nullopt;
    pose = pose_in(joint->child("origin")) * pose;
    link = *joint->child("parent")->attribute("link");
  }
  return link == into ? std::make_optional(pose) : std::nullopt;
}

// libsdformat names the link that a plug-in's body is lumped into, but gets the offset to it wrong
// where that takes several joints.
void fix_offset(const Element& given, const Element& robot, Element& made) {
  const std::string body = given.child_text("bodyName");
  const std::string into = made.child_text("bodyName");
  if (body.empty() || body == into) return;
  const std::optional<Pose> lumped = lumped_pose(robot, body, into);
  if (!lumped) return;
  Element offset;
  offset.attributes = {{"xyz", given.child_text("xyzOffset")},
                       {"rpy", given.child_text("rpyOffset")}};
  const std::string text = pose_text(*lumped * pose_in(&offset));
  const std::vector<double> v = numbers_in(text).values;
  const auto three = [&](std::size_t from) {
    return number_text(v[from]) + " " + number_text(v[from + 1]) + " " + number_text(v[from + 2]);
  };
  set_child(made, "xyzOffset", three(0));
  set_child(made, "rpyOffset", three(3));
}

void give_source(Element& element, const Source& source) {
  element.source = source;
  for (Element& child : element.children) give_source(child, source);
}

// The plug-ins of a robot keep their lines, and sit where they should.
void fix_plugins(const Element& robot, Element& root) {
  Element* model = find_child(root, "model");
  if (model == nullptr) return;
  for (const Element& extension : robot.children) {
    if (extension.name != "gazebo") continue;
    for (const Element& given : extension.children) {
      for (Element& made : model->children) {
        if (given.name != "plugin" || made.name != "plugin") continue;
        if (given.attributes != made.attributes && name_of(given) != name_of(made)) continue;
        give_source(made, given.source);
        fix_offset(given, robot, made);
      }
    }
  }
}

// Whether a <gazebo> element of that link, and not of one that was made one with it, turns it off.
bool turns_gravity_off(const Element& robot, const std::string& link) {
  return std::any_of(robot.children.begin(), robot.children.end(), [&](const Element& extension) {
    const std::string* of = extension.attribute("reference");
    return extension.name == "gazebo" && of != nullptr && *of == link &&
           (extension.child("turnGravityOff") != nullptr || extension.child("gravity") != nullptr);
  });
}

// libsdformat takes the gravity of a whole robot if a sensor that is fixed to it has none.
void keep_gravity(const Element& robot, Element& model) {
  for (Element& link : model.children) {
    if (link.name != "link" || turns_gravity_off(robot, name_of(link))) continue;
    remove_children(link, "gravity");
  }
}

Element text_element(const std::string& name, const std::string& text, const Source& source) {
  return {name, text, {}, {}, source};
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
  for (Element& plugin : model.children) {
    const std::string* file = plugin.attribute("filename");
    if (plugin.name != "plugin" || file == nullptr || *file != "libgazebo_ros_control.so") continue;
    for (const Element& transmission : robot.children) {
      if (transmission.name != "transmission") continue;
      for (const auto& [joint, interface] : driven_by(transmission)) {
        Element kept = text_element("transmission", "", transmission.source);
        kept.children = {text_element("joint", joint, transmission.source),
                         text_element("hardwareInterface", interface, transmission.source)};
        plugin.children.push_back(std::move(kept));
      }
    }
  }
}

// libsdformat would make one link of those that a force-torque sensor measures between.
std::string with_measured_joints(const std::string& text, const Element& robot) {
  std::string kept;
  for (const Element& extension : robot.children) {
    const Element* plugin = extension.name == "gazebo" ? extension.child("plugin") : nullptr;
    const std::string* file = plugin == nullptr ? nullptr : plugin->attribute("filename");
    if (file == nullptr || *file != kFtSensor) continue;
    const std::string name = measured_joint(*plugin, name_of(robot));
    for (const Element& joint : robot.children) {
      const std::string* type = joint.name == "joint" ? joint.attribute("type") : nullptr;
      if (type == nullptr || *type != "fixed" || name_of(joint) != name) continue;
      Element preserve = text_element("gazebo", "", joint.source);
      preserve.attributes = {{"reference", name}};
      preserve.children = {text_element("preserveFixedJoint", "true", joint.source)};
      kept += print_xml(preserve);
    }
  }
  const std::size_t end = text.rfind("</robot");
  return kept.empty() || end == std::string::npos ? text
                                                  : text.substr(0, end) + kept + text.substr(end);
}

// It has a plug-in that makes it follow, or a transmission.
bool has_driver(const std::string& joint, const Element& robot, const Element& model) {
  const auto follows = [&](const Element& plugin) {
    return plugin.name == "plugin" && plugin.child_text("mimicJoint") == joint;
  };
  const auto drives = [&](const Element& transmission) {
    if (transmission.name != "transmission") return false;
    const auto driven = driven_by(transmission);
    return std::any_of(driven.begin(), driven.end(),
                       [&](const auto& each) { return each.first == joint; });
  };
  return std::any_of(model.children.begin(), model.children.end(), follows) ||
         std::any_of(robot.children.begin(), robot.children.end(), drives);
}

// libsdformat drops <mimic>: a plug-in replaces it.
void keep_mimics(const Element& robot, Element& model) {
  for (const Element& joint : robot.children) {
    const Element* mimic = joint.name == "joint" ? joint.child("mimic") : nullptr;
    const std::string* leader = mimic == nullptr ? nullptr : mimic->attribute("joint");
    if (leader == nullptr || has_driver(name_of(joint), robot, model)) continue;
    Element plugin = text_element("plugin", "", mimic->source);
    plugin.attributes = {{"name", name_of(joint) + "_mimic"},
                         {"filename", "libroboticsgroup_gazebo_mimic_joint_plugin.so"}};
    plugin.children = {text_element("joint", *leader, mimic->source),
                       text_element("mimicJoint", name_of(joint), mimic->source)};
    for (const char* key : {"multiplier", "offset"}) {
      if (const std::string* value = mimic->attribute(key)) {
        plugin.children.push_back(text_element(key, *value, mimic->source));
      }
    }
    model.children.push_back(std::move(plugin));
  }
}

// The elements that the conversion writes, and those of <gazebo> elements.
std::set<std::string> names_in(const Element& robot) {
  std::istringstream words(
      "model link joint pose frame inertial mass inertia ixx ixy ixz iyy iyz izz collision visual "
      "sensor geometry box size cylinder radius length sphere mesh uri scale surface contact "
      "friction bounce ode kp kd mu mu2 fdir1 material script name axis axis2 xyz limit lower "
      "upper effort velocity dynamics damping spring_reference spring_stiffness parent child "
      "plugin static gravity self_collide max_vel min_depth diffuse ambient specular emissive "
      "use_parent_model_frame physics provide_feedback implicit_spring_damper cfm_damping "
      "fudge_factor torsional coefficient");
  std::set<std::string> names(std::istream_iterator<std::string>(words), {});
  collect_names(robot, names);
  return names;
}

}  // namespace

Element convert_urdf(const std::string& text, const Element& robot) {
  check_robot(robot);
  const SilenceConsole silence;
  const sdf::SDFPtr document = empty_document(names_in(robot));
  sdf::Errors errors;
  if (!sdf::readString(with_measured_joints(text, robot), document, errors) || !errors.empty()) {
    const std::string why = errors.empty() ? silence.messages() : errors.front().Message();
    throw Error(robot.source, "this URDF cannot be converted to SDF: " + why.substr(0, 300));
  }
  Element root = parse_xml(document->Root()->ToString(""), robot.source.file);
  place(root, &robot, robot, robot.source);
  for (const Element& child : robot.children) {
    if (child.name == "joint") keep_safety(child, root);
  }
  fix_plugins(robot, root);
  if (Element* model = find_child(root, "model")) {
    keep_gravity(robot, *model);
    keep_transmissions(robot, *model);
    keep_mimics(robot, *model);
  }
  return root;
}

}  // namespace angen::load
