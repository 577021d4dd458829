#include <cmath>

#include "core/limits.h"
#include "core/names.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/check.h"
#include "sdf/describe.h"
#include "sdf/reader.h"

namespace angen::load {

namespace {

constexpr char kTrousers[] = "0.22 0.22 0.26 1";
constexpr char kShirt[] = "0.20 0.36 0.60 1";
constexpr char kBare[] = "0.85 0.65 0.53 1";

std::string sphere_text(const std::string& radius) {
  return "<sphere><radius>" + radius + "</radius></sphere>";
}

std::string box_text(const std::string& size) { return "<box><size>" + size + "</size></box>"; }

std::string capsule_text(const std::string& radius, const std::string& length) {
  return "<capsule><radius>" + radius + "</radius><length>" + length + "</length></capsule>";
}

// The person's motor moves it, not its soles: it has no friction.
std::string collision_text(const std::string& name, const std::string& place,
                           const std::string& geometry) {
  return "<collision name='" + name + "'><pose>" + place + " 0 0 0</pose><geometry>" + geometry +
         "</geometry><surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>"
         "</collision>";
}

std::string visual_text(const std::string& name, const std::string& place,
                        const std::string& geometry, const std::string& color) {
  return "<visual name='" + name + "'><pose>" + place + " 0 0 0</pose><geometry>" + geometry +
         "</geometry><material><diffuse>" + color + "</diffuse></material></visual>";
}

// The plug-in moves the limbs by the names of their visuals.
std::string limb_texts(const std::string& side, const std::string& sign) {
  const std::string leg = " " + sign + "0.09 ";
  const std::string arm = " " + sign + "0.22 ";
  return visual_text("thigh" + side, "0" + leg + "0.685", capsule_text("0.08", "0.43"), kTrousers) +
         visual_text("shank" + side, "0" + leg + "0.28", capsule_text("0.058", "0.38"), kTrousers) +
         visual_text("foot" + side, "0.05" + leg + "0.035", box_text("0.25 0.09 0.07"),
                     "0.12 0.12 0.13 1") +
         visual_text("upper_arm" + side, "0" + arm + "1.27", capsule_text("0.05", "0.3"), kShirt) +
         visual_text("forearm" + side, "0" + arm + "0.99", capsule_text("0.042", "0.26"), kBare);
}

/// The body of an <actor>, and the plug-in that walks it. describe_actor() adds the actor's own
/// mass, temperatures and waypoints. The moments are those of a solid cylinder of a person's size.
/// Collisions of one that sits or lies are from the seat or the bed up, x ahead.
std::string person_text() {
  return "<model name='person'><link name='body'><inertial><pose>0 0 0.875 0 0 0</pose>"
         "<mass>70</mass><inertia><ixx>18.958333333333332</ixx><iyy>18.958333333333332</iyy>"
         "<izz>2.1875</izz></inertia></inertial>" +
         collision_text("collision", "0 0 0.875", capsule_text("0.25", "1.25")) +
         collision_text("sit_thighs", "0.15 0 0.07", box_text("0.54 0.34 0.14")) +
         collision_text("sit_trunk", "-0.02 0 0.38", box_text("0.2 0.48 0.48")) +
         collision_text("sit_shanks", "0.37 0 -0.19", box_text("0.1 0.31 0.38")) +
         collision_text("lie_legs", "-0.44 0 0.07", box_text("0.82 0.3 0.14")) +
         collision_text("lie_trunk", "0.24 0 0.09", box_text("0.54 0.48 0.18")) +
         collision_text("sit_head", "-0.02 0 0.75", sphere_text("0.11")) +
         collision_text("lie_head", "0.64 0 0.2", sphere_text("0.11")) +  //
         limb_texts("_left", "") + limb_texts("_right", "-") +
         visual_text("trunk", "0 0 1.15", capsule_text("0.17", "0.36"), kShirt) +
         visual_text("neck", "0 0 1.5",
                     "<cylinder><radius>0.055</radius><length>0.12</length></cylinder>", kBare) +
         visual_text("head", "0 0 1.635", sphere_text("0.115"), kBare) +
         visual_text("hair", "-0.02 0 1.645", sphere_text("0.113"), "0.25 0.18 0.14 1") +
         visual_text("nose", "0.115 0 1.625", sphere_text("0.02"), kBare) +
         "</link><plugin name='person' filename='libperson_controller.so'/></model>";
}

constexpr double kSkin = 307.0;      // K: of a bare face and hands
constexpr double kClothed = 299.0;   // K: of clothes, in a room
constexpr double kBareShare = 0.12;  // share of a clothed person's surface: head and hands

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
  Element person = parse_xml(person_text(), "actor.cpp");
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
      plugin.children.push_back({"waypoint", row(w), {}, {}, w.source});
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
