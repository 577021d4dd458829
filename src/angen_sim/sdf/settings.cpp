#include "core/text.h"
#include "document/values.h"
#include "sdf/describe.h"
#include "sdf/material.h"

namespace angen::load {

namespace {

void read_physics(const Element& element, desc::Physics& physics, Session& session) {
  const std::string* type = element.attribute("type");
  if (type != nullptr && *type != "ode" && *type != "ignored") {
    session.warn(element.source, "<physics type=\"" + *type +
                                     "\">: ODE is used, the one engine here; write type=\"ode\"");
  }
  if (const Element* step = element.child("max_step_size")) {
    const double seconds = number_of(*step);
    if (seconds < 1e-9 || seconds > 1.0) {
      throw Error(step->source, "<max_step_size> is " + number_text(seconds) +
                                    " s; give 1e-9 to 1, such as 0.001");
    }
    physics.step = from_seconds(seconds);
  }
  physics.real_time_factor = child_number(element, "real_time_factor", physics.real_time_factor);
  // SDF's way to say "as fast as possible".
  if (child_number(element, "real_time_update_rate", 1000.0) == 0.0) physics.real_time_factor = 0.0;
  const Element* ode = element.child("ode");
  if (ode == nullptr) return;
  if (const Element* solver = ode->child("solver")) {
    physics.iterations = static_cast<int>(child_number(*solver, "iters", physics.iterations));
  }
  if (const Element* constraints = ode->child("constraints")) {
    physics.erp = child_number(*constraints, "erp", physics.erp);
    physics.cfm = child_number(*constraints, "cfm", physics.cfm);
    physics.contact_max_correcting_vel = child_number(*constraints, "contact_max_correcting_vel",
                                                      physics.contact_max_correcting_vel);
    physics.contact_surface_layer =
        child_number(*constraints, "contact_surface_layer", physics.contact_surface_layer);
  }
}

}  // namespace

const Element* chosen_physics(const Element& world) {
  const Element* chosen = nullptr;
  for (const Element& child : world.children) {
    if (child.name != "physics") continue;
    const std::string* wanted = child.attribute("default");
    const bool is_default = wanted != nullptr && (*wanted == "true" || *wanted == "1");
    if (chosen == nullptr || is_default) chosen = &child;
  }
  return chosen;
}

void read_settings(const Element& world, desc::World& to, Session& session) {
  if (const Element* physics = chosen_physics(world)) {
    read_physics(*physics, to.physics, session);
  }
  if (const Element* gravity = world.child("gravity")) {
    const std::vector<double> v = numbers_of(*gravity, 3);
    to.gravity = {v[0], v[1], v[2]};
  }
  if (const Element* atmosphere = world.child("atmosphere")) {
    to.ambient_temperature = child_number(*atmosphere, "temperature", to.ambient_temperature);
  }
  if (const Element* scene = world.child("scene")) {
    if (const Element* ambient = scene->child("ambient")) to.scene.ambient = color_of(*ambient);
    if (const Element* background = scene->child("background")) {
      to.scene.background = color_of(*background);
    }
    to.scene.shadows = child_flag(*scene, "shadows", to.scene.shadows);
  }
}

}  // namespace angen::load
