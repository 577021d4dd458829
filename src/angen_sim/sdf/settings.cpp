#include "sdf/describe.h"
#include "sdf/home.h"
#include "sdf/reader.h"

namespace angen::load {

namespace {

void read_physics(const Reader& element, desc::Physics& physics, Session& session) {
  const std::string* type = element.attribute("type");
  element.attribute("default");
  if (type != nullptr && *type != "ode" && *type != "ignored") {
    session.warn(
        element.element().source,
        "<physics type=\"" + *type + "\">: ODE is used, the one engine here; write type=\"ode\"");
  }
  const Range step = Range::positive({"s", 1.0, 1e-9});
  if (const auto seconds = element.number("max_step_size", step)) {
    physics.step = from_seconds(*seconds);
  }
  physics.real_time_factor =
      element.number("real_time_factor", physics.real_time_factor, Range::not_negative({"", 1e6}));
  // SDF's way to say "as fast as possible".
  if (element.number("real_time_update_rate", Range::not_negative()) == 0.0) {
    physics.real_time_factor = 0.0;
  }
  const Reader ode = element.block("ode");
  const Range iterations = Range::solver(1.0, 1e4, Range::Sign::kPositive);
  physics.iterations =
      static_cast<int>(ode.block("solver").number("iters", physics.iterations, iterations));
  const Element* solver = ode.block("solver").child("type");  // the exact one, as here
  if (solver != nullptr && solver->text != "world") {
    session.ignore(solver->source, "<type> in <solver>");
  }
  const Reader constraints = ode.block("constraints");
  physics.erp = constraints.number("erp", physics.erp, Range::solver(0.0, 1.0));
  physics.cfm = constraints.number("cfm", physics.cfm, Range::solver(0.0, 1e6));
  physics.contact_max_correcting_vel =
      constraints.number("contact_max_correcting_vel", physics.contact_max_correcting_vel,
                         Range::solver(0.0, limits::kSpeed.most));
  physics.contact_surface_layer = constraints.number(
      "contact_surface_layer", physics.contact_surface_layer, Range::solver(0.0, 1.0));
}

}  // namespace

const Element* chosen_physics(const Element& world) {
  const Element* chosen = nullptr;
  for (const Element& child : world.children) {
    if (child.name != "physics") continue;
    const std::string* marked = child.attribute("default");
    const bool is_default = marked != nullptr && (*marked == "true" || *marked == "1");
    if (chosen == nullptr || is_default) chosen = &child;
  }
  return chosen;
}

void read_settings(const Element& element, desc::World& to, Session& session) {
  const Reader world(element, session);
  if (const Element* physics = chosen_physics(element)) {
    read_physics({*physics, session}, to.physics, session);
  }
  to.gravity = world.vector("gravity", to.gravity, Range::any(limits::kGravity));
  const Reader atmosphere = world.block("atmosphere");
  atmosphere.attribute("type");
  to.ambient_temperature = atmosphere.number("temperature", to.ambient_temperature,
                                             Range::positive(limits::kTemperature));
  const Reader scene = world.block("scene");
  if (const auto ambient = scene.color("ambient")) to.scene.ambient = *ambient;
  if (const auto background = scene.color("background")) to.scene.background = *background;
  to.scene.shadows = scene.flag("shadows", to.scene.shadows);
  for (const Element& child : element.children) {
    if (child.name == "frame") Reader(child, session).attribute("attached_to");
    if (child.name == "plugin") to.plugins.push_back(plugin_of(child));
  }
  world.note({"plugin"});
  read_home_parts(world, Pose{}, to.home, session);
  to.site = home_site_of(world, session);
}

}  // namespace angen::load
