#include "import/gazebo_model.h"

#include "document/xml.h"

namespace angen::load {

namespace {

void add_default(Element& plugin, const std::string& name, const std::string& value) {
  if (plugin.child(name) == nullptr) set_child(plugin, name, value);
}

}  // namespace

std::string measured_joint(const Element& plugin, const std::string& model) {
  const std::string name = plugin.child_text("jointName");
  const std::string prefix = model + "::";
  return name.rfind(prefix, 0) == 0 ? name.substr(prefix.size()) : name;
}

void hold_measured_joints(desc::Model& model) {
  for (const desc::Plugin& plugin : model.plugins) {
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

void add_bumper_defaults(desc::Model& model) {
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
