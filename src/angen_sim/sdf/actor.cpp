#include <cmath>

#include "core/limits.h"
#include "core/names.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/person.h"
#include "sdf/reader.h"

namespace angen::load {

namespace {

constexpr double kSkin = 307.0;      // K: of a bare face and hands
constexpr double kClothed = 299.0;   // K: of clothes, in a room
constexpr double kBareShare = 0.12;  // share of a clothed person's surface: head and hands

Element leaf(const std::string& name, const std::string& text, const Source& source) {
  Element element;
  element.name = name;
  element.text = text;
  element.source = source;
  return element;
}

struct Waypoint {
  double time;
  Pose pose;
  Source source;
};

// The rows of all trajectories, in the order of the file, which must be that of time.
std::vector<Waypoint> waypoints_of(const Element& script, const Pose& place, Session& session) {
  std::vector<Waypoint> all;
  for (const Element& trajectory : script.children) {
    if (trajectory.name != "trajectory") continue;
    const Reader path(trajectory, session);
    path.attribute("type");  // an animation's, which people here do not have
    path.attribute("id");
    for (const Element& element : trajectory.children) {
      if (element.name != "waypoint") continue;
      const Reader waypoint(element, session);
      const Element* time = waypoint.child("time");
      const Element* pose = element.child("pose");
      if (time == nullptr || pose == nullptr) {
        throw Error(element.source, "<waypoint> needs a <time> and a <pose>");
      }
      const double t = waypoint.number("time", 0.0, Range::not_negative(limits::kTime));
      if (!all.empty() && t <= all.back().time) {
        throw Error(time->source, "the waypoint's time " + number_text(t) +
                                      " is not after the one before, " +
                                      number_text(all.back().time));
      }
      all.push_back({t, place * pose_of(*pose), element.source});
    }
  }
  return all;
}

std::string row(const Waypoint& w) {
  const Vec3& p = w.pose.position;
  std::string text = number_text(w.time);
  for (const double v : {p.x(), p.y(), p.z(), yaw_of(w.pose.rotation)})
    text += " " + number_text(v);
  return text;
}

// The temperature at which a surface radiates as much as skin and clothes together.
double mean_temperature(double skin, double clothed) {
  return std::pow(kBareShare * std::pow(skin, 4) + (1.0 - kBareShare) * std::pow(clothed, 4), 0.25);
}

double given_temperature(const Element& plugin, const std::string& name, double fallback) {
  const double kelvin = child_number(plugin, name, fallback);
  if (kelvin > 0.0) return kelvin;
  throw Error(plugin.child(name)->source,
              "<" + name + "> is " + number_text(kelvin) + " K; it must be greater than 0");
}

void set_source(Element& element, const Source& source) {
  element.source = source;
  for (Element& child : element.children) set_source(child, source);
}

}  // namespace

desc::Model describe_actor(const Element& given, Session& session) {
  check_name(name_of(given), "<actor>", given.source);
  Element actor = given;
  check_poses(actor, session);
  const Reader reader(actor, session);
  reader.note({"plugin"});
  const Element* pose = actor.child("pose");
  if (pose != nullptr && pose->attribute("relative_to") != nullptr) {
    throw Error(pose->source, "an actor's pose is given in the world; leave relative_to out");
  }
  Element person = parse_xml(kPerson, "person.h");
  set_source(person, actor.source);
  Element plugin = *person.child("plugin");
  remove_children(person, "plugin");
  desc::Model model = describe_model(person, session);
  model.name = name_of(actor);
  model.source = actor.source;
  model.pose = child_pose(actor);
  model.is_actor = true;
  desc::Link& body = model.links.front();

  std::vector<Element> others;
  for (const Element& child : actor.children) {
    if (child.name != "plugin") continue;
    const std::string* file = child.attribute("filename");
    if (file == nullptr || *file == *plugin.attribute("filename")) {
      // If several give a parameter, as where an <include> adds a plug-in, the last one holds.
      for (const Element& given : child.children) remove_children(plugin, given.name);
      plugin.children.insert(plugin.children.end(), child.children.begin(), child.children.end());
    } else {
      others.push_back(child);
    }
  }
  if (const Reader script = reader.block("script")) {
    const std::vector<Waypoint> waypoints = waypoints_of(script.element(), model.pose, session);
    for (const Waypoint& w : waypoints) {
      plugin.children.push_back(leaf("waypoint", row(w), w.source));
    }
    script.flag("loop", false);
    script.number("delay_start", Range::not_negative(limits::kTime));
    for (const char* name : {"loop", "delay_start"}) {
      if (const Element* value = script.child(name)) plugin.children.push_back(*value);
    }
    if (!script.flag("auto_start", true)) {
      session.warn(script.child("auto_start")->source,
                   "<auto_start> false has no effect; send the person Stop and Go instead");
    }
    if (!waypoints.empty()) model.pose = waypoints.front().pose;
  }
  model.pose.rotation = from_rpy(0.0, 0.0, yaw_of(model.pose.rotation));
  const double mass = child_number(plugin, "mass", body.inertial.mass);
  if (!(mass > 0.0)) {
    throw Error(plugin.child("mass")->source,
                "<mass> is " + number_text(mass) + " kg; it must be greater than 0");
  }
  body.inertial.moment *= mass / body.inertial.mass;
  body.inertial.mass = mass;
  // Rays hit one capsule, which is like the first visual: its temperature is the whole body's.
  const double temperature =
      mean_temperature(given_temperature(plugin, "skin_temperature", kSkin),
                       given_temperature(plugin, "clothing_temperature", kClothed));
  for (desc::Visual& each : body.visuals) each.temperature = temperature;
  model.plugins = {plugin_of(plugin)};
  for (const Element& other : others) model.plugins.push_back(plugin_of(other));
  note_ignored(actor, session);
  return model;
}

}  // namespace angen::load
