#include "gazebo/model_text.h"

#include "core/diagnostics.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"

namespace angen::node::gazebo {

namespace {

constexpr const char* kSpawned = "(text)";
constexpr const char* kNamespace = "robotNamespace";

bool stands_for_entity(const Element& element) {
  return element.name == "model" || element.name == "include" || element.name == "light" ||
         element.name == "actor";
}

// <sdf><world><include/></world></sdf>, as -database of spawn_model sends it.
bool take_out_of_world(Element& sdf) {
  if (sdf.name != "sdf" || sdf.children.size() != 1) return false;
  const Element& world = sdf.children[0];
  if (world.name != "world" || world.children.size() != 1) return false;
  if (!stands_for_entity(world.children[0])) return false;
  sdf.children = {Element(world.children[0])};
  return true;
}

// All others take none for "/", and keep their lines in the text.
bool needs_namespace(const Element& plugin, const std::string& robot_namespace) {
  if (plugin.child(kNamespace) != nullptr) return false;
  return robot_namespace != "/" || plugin.attribute_text("filename") == "libgazebo_ros_control.so";
}

bool give_namespace(Element& element, const std::string& robot_namespace) {
  bool changed = false;
  if (element.name == "plugin" && needs_namespace(element, robot_namespace)) {
    element.children.push_back({kNamespace, robot_namespace});
    changed = true;
  }
  for (Element& child : element.children) {
    changed = give_namespace(child, robot_namespace) || changed;
  }
  return changed;
}

const Element* entity_in(const Element& root) {
  if (stands_for_entity(root)) return &root;
  if (root.name != "sdf" || root.children.size() != 1) return nullptr;
  return stands_for_entity(root.children[0]) ? &root.children[0] : nullptr;
}

}  // namespace

bool is_urdf(const std::string& xml) {
  const Element root = load::parse_xml(xml, kSpawned);
  if (root.name == "robot") return true;
  if (root.name == "sdf" || root.name == "gazebo" || stands_for_entity(root)) return false;
  throw Error("the root element is <" + printable(root.name) + ">; give <sdf> or <robot>");
}

ModelText model_text(const std::string& xml, const std::string& robot_namespace) {
  Element root = load::parse_xml(xml, kSpawned);
  bool changed = take_out_of_world(root);
  if (!robot_namespace.empty()) changed = give_namespace(root, robot_namespace) || changed;
  ModelText text;
  const Element* entity = entity_in(root);
  // A light's own pose is read with it.
  if (entity != nullptr && entity->name != "light") text.own_pose = load::child_pose(*entity);
  text.xml = changed ? load::print_xml_in_place(root) : xml;
  return text;
}

}  // namespace angen::node::gazebo
