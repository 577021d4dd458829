#include "gazebo/lights.h"

#include <gazebo_msgs/DeleteLight.h>
#include <gazebo_msgs/GetLightProperties.h>
#include <gazebo_msgs/SetLightProperties.h>

#include <cmath>

#include "core/text.h"
#include "document/xml.h"
#include "gazebo/names.h"

namespace angen::node::gazebo {

namespace {

const Element* find_light(const Element& element, const std::string& name) {
  if (element.name == "light" && load::name_of(element) == name) return &element;
  for (const Element& child : element.children) {
    if (const Element* found = find_light(child, name)) return found;
  }
  return nullptr;
}

double number_in(const Element& attenuation, const char* name, double fallback) {
  return parse_finite(attenuation.child_text(name)).value_or(fallback);
}

void check_finite(const gazebo_msgs::SetLightProperties::Request& request) {
  for (const std_msgs::ColorRGBA* color : {&request.diffuse, &request.specular}) {
    for (const float value : {color->r, color->g, color->b, color->a}) {
      if (!std::isfinite(value)) throw Error("a color is not finite");
    }
  }
  for (const double value :
       {request.attenuation_constant, request.attenuation_linear, request.attenuation_quadratic}) {
    if (!std::isfinite(value)) throw Error("the attenuation is not finite");
  }
}

// The text that has the light: of its model, or of the world.
std::string text_with(const sim::Structure& structure, const sim::LightEntry& light,
                      const desc::World& world) {
  if (light.model == UINT32_MAX) return world.xml;
  const desc::Model& model = *structure.models[light.model];
  return model.expanded_xml.empty() ? model.xml : model.expanded_xml;
}

// Lights of requests are those of the building by full name; others are not found.
const sim::LightEntry& light_in(const sim::Structure& structure, const std::string& name,
                                const char* title) {
  try {
    return light_named(structure, name);
  } catch (const NotFound& missing) {
    throw Failed(std::string(title) + ": " + missing.text());
  }
}

}  // namespace

Lights::Unused Lights::unused_of(const sim::Structure& structure, const sim::LightEntry& light) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto kept = unused_.find(light.name);
    if (kept != unused_.end()) return kept->second;
  }
  Unused unused;
  const std::string text = text_with(structure, light, inbox_.simulation().world());
  if (text.empty()) return unused;
  const Element root = load::parse_xml(text, light.name);
  const Element* element = find_light(root, light.light.name);
  if (element != nullptr) read_attenuation(*element, unused);
  return unused;
}

void Lights::read_attenuation(const Element& light, Unused& to) {
  const Element* attenuation = light.child("attenuation");
  if (attenuation == nullptr) return;
  to.constant = number_in(*attenuation, "constant", to.constant);
  to.linear = number_in(*attenuation, "linear", to.linear);
  to.quadratic = number_in(*attenuation, "quadratic", to.quadratic);
}

void Lights::note_spawned(const std::string& name, const std::string& sdf) {
  Unused unused;
  const Element root = load::parse_xml(sdf, name);
  read_attenuation(root.name == "sdf" && !root.children.empty() ? root.children[0] : root, unused);
  const std::lock_guard<std::mutex> lock(mutex_);
  unused_[name] = unused;
}

Lights::Lights(Server& server) : inbox_(server.inbox()) {
  using namespace gazebo_msgs;
  server.serve<GetLightProperties>("getLightProperties", [this](const auto& request,
                                                                auto& response) {
    const auto structure = structure_of(inbox_);
    const sim::LightEntry& light = light_in(*structure, request.light_name, "getLightProperties");
    const Unused unused = unused_of(*structure, light);
    response.diffuse.r = light.light.diffuse[0];
    response.diffuse.g = light.light.diffuse[1];
    response.diffuse.b = light.light.diffuse[2];
    response.diffuse.a = unused.alpha;
    response.attenuation_constant = unused.constant;
    response.attenuation_linear = unused.linear;
    response.attenuation_quadratic = unused.quadratic;
    return "";
  });
  server.serve<SetLightProperties>("setLightProperties", [this](const auto& request, auto&) {
    const auto structure = structure_of(inbox_);
    check_finite(request);
    sim::SetLight to;
    to.light = light_in(*structure, request.light_name, "setLightProperties").name;
    to.diffuse = {request.diffuse.r, request.diffuse.g, request.diffuse.b};
    to.cast_shadows = request.cast_shadows != 0;
    to.direction = vector_of(request.direction);
    to.pose = pose_of(request.pose);
    edit(inbox_, to);
    const std::lock_guard<std::mutex> lock(mutex_);
    unused_[to.light] = {request.diffuse.a, request.attenuation_constant,
                         request.attenuation_linear, request.attenuation_quadratic};
    return "";
  });
  server.serve<DeleteLight>("DeleteLight", [this](const auto& request, auto&) {
    const auto structure = structure_of(inbox_);
    const std::string light = light_in(*structure, request.light_name, "DeleteLight").name;
    edit(inbox_, sim::DeleteLight{light});
    const std::lock_guard<std::mutex> lock(mutex_);
    unused_.erase(light);
    return "DeleteLight: " + printable(request.light_name) + " successfully deleted";
  });
}

}  // namespace angen::node::gazebo
