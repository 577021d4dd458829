#include "import/gazebo.h"

#include <set>
#include <string>
#include <utility>

#include "core/names.h"
#include "desc/world.h"
#include "document/xml.h"

namespace angen::load {

namespace {

const Gazebo gazebo;
const GazeboRegistration registration(gazebo);

desc::Customs customs() {
  desc::Customs customs;
  customs.sets_aside = customs.first_holds = true;
  customs.lights_are_lamps = customs.keeps_frames = true;
  customs.parting_speed = 1.0;  // Gazebo lifts a robot that is spawned deep in the floor by 1 cm/s
  return customs;
}

void add_default(Element& plugin, const std::string& name, const std::string& value) {
  if (plugin.child(name) == nullptr) set_child(plugin, name, value);
}

}  // namespace

std::string measured_joint(const Element& plugin, const std::string& model) {
  return local_name(model, plugin.child_text("jointName"));
}

// Several of a library may have one name: later ones get another. Fixed joints that a force-torque
// sensor measures become hinges that their stops hold: links on fixed joints are one body.
void Gazebo::prepare_plugins(desc::Model& model) const {
  std::set<std::pair<std::string, std::string>> seen;
  for (desc::Plugin& plugin : model.plugins) {
    const std::string given = plugin.name;
    for (int twin = 2; plugin.is_repeatable && !seen.emplace(plugin.filename, plugin.name).second;
         ++twin) {
      plugin.name = given + "_" + std::to_string(twin);
    }
    if (plugin.filename != kFtSensor) continue;
    const std::string name = measured_joint(plugin.element, model.name);
    for (desc::Joint& joint : model.joints) {
      if (joint.name != name || joint.type != desc::Joint::Type::kFixed) continue;
      joint.type = desc::Joint::Type::kRevolute;
      joint.axes.emplace_back();
      joint.axes.back().lower = joint.axes.back().upper = 0.0;
    }
  }
}

void Gazebo::complete(desc::World& world) const { world.customs = customs(); }

// Bumpers that give none have a topic and frame.
void Gazebo::complete(desc::Model& model) const {
  model.customs = customs();
  for (desc::Link& link : model.links) {
    for (desc::Sensor& sensor : link.sensors) {
      if (sensor.plugin != "libgazebo_ros_bumper.so") continue;
      if (sensor.plugin_element.child("topicName") == nullptr) {
        add_default(sensor.plugin_element, "bumperTopicName", "bumper_states");
      }
      add_default(sensor.plugin_element, "frameName", "world");
    }
  }
}

}  // namespace angen::load
