#include "load/urdf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/text.h"
#include "load/describe.h"
#include "load/sdf.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

namespace {

void need_link(const Element& joint, const char* end, const std::set<std::string>& links) {
  const Element* element = joint.child(end);
  const std::string* link = element == nullptr ? nullptr : element->attribute("link");
  if (link == nullptr) {
    throw Error(joint.source, tag_of(joint) + " has no <" + end + " link=\"…\"/>; name a link");
  }
  if (links.count(*link) == 0) {
    throw Error(element->source, tag_of(joint) + " names an unknown link '" + printable(*link) +
                                     "'; known are " + join_names({links.begin(), links.end()}));
  }
}

void check_numbers(const Element& element) {
  static const std::set<std::string> texts = {"name",        "link",      "type",
                                              "filename",    "reference", "joint",
                                              "xmlns:xacro", "version",   "value_type"};
  static const std::map<std::string, std::size_t> rows = {
      {"xyz", 3}, {"rpy", 3}, {"size", 3}, {"scale", 3}, {"rgba", 4}};
  static const std::set<std::string> limits = {"lower", "upper", "effort", "velocity"};
  if (element.name == "gazebo" || element.name == "transmission") return;
  for (const auto& [key, value] : element.attributes) {
    if (texts.count(key) != 0) continue;
    const Numbers found = numbers_in(value);
    const std::string where = "<" + element.name + " " + key + "> holds '";
    if (!found.bad.empty()) {
      throw Error(element.source, where + printable(found.bad) + "', which is not a number");
    }
    const auto row = rows.find(key);
    const std::size_t count = row == rows.end() ? 1 : row->second;
    const bool any = limits.count(key) != 0;
    const bool good = std::all_of(found.values.begin(), found.values.end(), [&](double v) {
      return any ? !std::isnan(v) : std::isfinite(v);
    });
    if (found.values.size() != count || !good) {
      throw Error(element.source, where + printable(value) + "'; give " + std::to_string(count) +
                                      " finite number" + (count == 1 ? "" : "s"));
    }
  }
  for (const Element& child : element.children) check_numbers(child);
}

void check_robot(const Element& robot) {
  std::set<std::string> links;
  std::set<std::string> joints;
  for (const Element& child : robot.children) {
    if (child.name != "link" && child.name != "joint") continue;
    auto& names = child.name == "link" ? links : joints;
    if (name_of(child).empty()) throw Error(child.source, "<" + child.name + "> has no name");
    if (!names.insert(name_of(child)).second) {
      throw Error(child.source, "the name '" + name_of(child) + "' is given twice; give this <" +
                                    child.name + "> another");
    }
    check_numbers(child);
  }
  if (links.empty()) throw Error(robot.source, "<robot> has no <link>; give it one");
  for (const Element& child : robot.children) {
    if (child.name != "joint") continue;
    need_link(child, "parent", links);
    need_link(child, "child", links);
  }
}

// Elements that libsdformat made keep the place of the URDF element of the same kind and name.
void place(Element& element, const Element& robot, const Source& around) {
  element.source = around;
  for (const Element& original : robot.children) {
    if (original.name == element.name && !name_of(original).empty() &&
        name_of(original) == name_of(element)) {
      element.source = original.source;
    }
  }
  for (Element& child : element.children) place(child, robot, element.source);
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

// Where a link is in another one that fixed joints hold it to, some way up; none where it is not.
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
void mend_offset(const Element& given, const Element& robot, Element& made) {
  const std::string body = child_text(given, "bodyName");
  const std::string into = child_text(made, "bodyName");
  if (body.empty() || body == into) return;
  const std::optional<Pose> lumped = lumped_pose(robot, body, into);
  if (!lumped) return;
  Element offset;
  offset.attributes = {{"xyz", child_text(given, "xyzOffset")},
                       {"rpy", child_text(given, "rpyOffset")}};
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
void mend_plugins(const Element& robot, Element& root) {
  Element* model = find_child(root, "model");
  if (model == nullptr) return;
  for (const Element& extension : robot.children) {
    if (extension.name != "gazebo") continue;
    for (const Element& given : extension.children) {
      for (Element& made : model->children) {
        if (given.name != "plugin" || made.name != "plugin") continue;
        if (given.attributes != made.attributes && name_of(given) != name_of(made)) continue;
        give_source(made, given.source);
        mend_offset(given, robot, made);
      }
    }
  }
}

// What the conversion writes, and what <gazebo> elements add.
std::set<std::string> names_in(const Element& robot) {
  std::set<std::string> names = {"model",
                                 "link",
                                 "joint",
                                 "pose",
                                 "frame",
                                 "inertial",
                                 "mass",
                                 "inertia",
                                 "ixx",
                                 "ixy",
                                 "ixz",
                                 "iyy",
                                 "iyz",
                                 "izz",
                                 "collision",
                                 "visual",
                                 "sensor",
                                 "geometry",
                                 "box",
                                 "size",
                                 "cylinder",
                                 "radius",
                                 "length",
                                 "sphere",
                                 "mesh",
                                 "uri",
                                 "scale",
                                 "surface",
                                 "contact",
                                 "friction",
                                 "bounce",
                                 "ode",
                                 "kp",
                                 "kd",
                                 "mu",
                                 "mu2",
                                 "fdir1",
                                 "material",
                                 "script",
                                 "name",
                                 "axis",
                                 "axis2",
                                 "xyz",
                                 "limit",
                                 "lower",
                                 "upper",
                                 "effort",
                                 "velocity",
                                 "dynamics",
                                 "damping",
                                 "spring_reference",
                                 "spring_stiffness",
                                 "parent",
                                 "child",
                                 "plugin",
                                 "static",
                                 "gravity",
                                 "self_collide",
                                 "max_vel",
                                 "min_depth",
                                 "diffuse",
                                 "ambient",
                                 "specular",
                                 "emissive",
                                 "use_parent_model_frame",
                                 "physics",
                                 "provide_feedback",
                                 "implicit_spring_damper",
                                 "cfm_damping",
                                 "fudge_factor",
                                 "torsional",
                                 "coefficient"};
  collect_names(robot, names);
  return names;
}

}  // namespace

Element convert_urdf(const std::string& text, const Element& robot) {
  check_robot(robot);
  const Hush hush;
  const sdf::SDFPtr document = empty_document(names_in(robot));
  sdf::Errors errors;
  if (!sdf::readString(text, document, errors) || !errors.empty()) {
    const std::string why = errors.empty() ? hush.messages() : errors.front().Message();
    throw Error(robot.source, "this URDF cannot be converted to SDF: " + why.substr(0, 300));
  }
  Element root = parse_xml(document->Root()->ToString(""), robot.source.file);
  place(root, robot, robot.source);
  for (const Element& child : robot.children) {
    if (child.name == "joint") keep_safety(child, root);
  }
  mend_plugins(robot, root);
  return root;
}

}  // namespace angen::load
