#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "sdf/load.h"
#include "sim/simulation.h"

/// A robot as others write them, in a simulation.
namespace angen::robots {

inline std::string wheel(const std::string& name, double x, double y) {
  const std::string at = std::to_string(x) + " " + std::to_string(y) + " 0.05 0 0 0";
  return "<link name='" + name + "'><pose>" + at +
         "</pose><inertial><mass>0.2</mass><inertia><ixx>0.0002</ixx><iyy>0.0003</iyy>"
         "<izz>0.0002</izz></inertia></inertial><collision name='c'><pose>0 0 0 1.5707963 0 0"
         "</pose><geometry><cylinder><radius>0.05</radius><length>0.02</length></cylinder>"
         "</geometry></collision></link><joint name='" +
         name + "_joint' type='continuous'><parent>body</parent><child>" + name +
         "</child><axis><xyz>0 1 0</xyz></axis></joint>";
}

/// A body on two wheels 0.3 m apart and a slippery ball; `more` belongs to its model.
inline std::string robot(const std::string& more) {
  return "<model name='bot'><link name='body'><inertial><pose>-0.04 0 0.06 0 0 "
         "0</pose><mass>3</mass>"
         "<inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.03</izz></inertia></inertial>"
         "<collision name='b'><pose>0 0 0.08 0 0 0</pose><geometry><box><size>0.3 0.2 0.08</size>"
         "</box></geometry></collision><collision name='ball'><pose>-0.12 0 0.02 0 0 0</pose>"
         "<geometry><sphere><radius>0.02</radius></sphere></geometry><surface><friction><ode>"
         "<mu>0</mu><mu2>0</mu2></ode></friction></surface></collision></link>" +
         wheel("left", 0.0, 0.15) + wheel("right", 0.0, -0.15) + more + "</model>";
}

inline std::string plugin(const std::string& library, const std::string& more,
                          const std::string& name = "p") {
  return "<plugin name='" + name + "' filename='libgazebo_ros_" + library + ".so'>" + more +
         "</plugin>";
}

/// A loose box; `more` belongs to its link.
inline std::string box(const std::string& name, double mass, const std::string& pose,
                       const std::string& size, const std::string& more = "") {
  const std::string moment = std::to_string(mass / 100.0);
  return "<link name='" + name + "'><pose>" + pose + "</pose><inertial><mass>" +
         std::to_string(mass) + "</mass><inertia><ixx>" + moment + "</ixx><iyy>" + moment +
         "</iyy><izz>" + moment + "</izz></inertia></inertial><collision name='c'><geometry><box>" +
         "<size>" + size + "</size></box></geometry></collision>" + more + "</link>";
}

/// A joint to `child` about or along y, at its origin.
inline std::string joint(const std::string& child, const std::string& parent,
                         const std::string& type, double lower = -3.0, double upper = 3.0) {
  return "<joint name='" + child + "_joint' type='" + type + "'><parent>" + parent +
         "</parent><child>" + child + "</child><axis><xyz>0 1 0</xyz><limit><lower>" +
         std::to_string(lower) + "</lower><upper>" + std::to_string(upper) +
         "</upper></limit></axis></joint>";
}

/// Two arms of 1 kg, 0.2 m behind their joints about y, in the air; `more` belongs to their model.
inline std::string arms(const std::string& more, const std::string& limits = "") {
  std::string text =
      "<model name='bot'><link name='body'><pose>0 0 1 0 0 0</pose></link>"
      "<joint name='base' type='fixed'><parent>world</parent><child>body</child>"
      "</joint>";
  for (const char* name : {"left", "right"}) {
    const std::string y = std::string(name) == "left" ? "0.3" : "-0.3";
    text += "<link name='" + std::string(name) + "'><pose>0 " + y +
            " 1 0 0 0</pose><inertial><pose>0.2 0 0 0 0 0</pose><mass>1</mass><inertia><ixx>0.001"
            "</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial></link><joint name='" +
            name + "_joint' type='revolute'><parent>body</parent><child>" + name +
            "</child><axis><xyz>0 1 0</xyz>" + limits + "</axis></joint>";
  }
  return text + more + "</model>";
}

/// `models` on a floor.
class Hall {
 public:
  explicit Hall(const std::string& models, bool tolerant = false)
      : simulation(load::world_from_text(
                       "<sdf version='1.6'><world name='w'" +
                           std::string(tolerant ? " angen:strict='false'" : "") +
                           "><model name='floor'><static>true</static><link name='l'><collision "
                           "name='c'><geometry><plane/></geometry></collision></link></model>" +
                           models + "</world></sdf>",
                       "hall.world", {}),
                   1, std::make_shared<Catalog>()) {
    snapshot = simulation.snapshot();  // its structure is as the world was built
    for (const sim::Event& event : snapshot->events) {
      if (event.event == "warning") warnings.push_back(event.detail);
    }
    snapshot = simulation.tick();
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(1000 * seconds); ++i) snapshot = simulation.tick();
  }
  void command(const std::string& kind, const std::vector<double>& values,
               const std::string& name = "bot", const std::string& text = "") {
    simulation.post(sim::ToDevice{kind, name, {text, values, "", 0.0}});
  }
  std::size_t sensor(const std::string& kind) const {
    const auto& sensors = snapshot->structure->sensors;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      if (sensors[i].kind == kind) return i;
    }
    throw Error("no sensor of kind " + kind);
  }
  Reading reading(const std::string& kind) const { return *snapshot->reading(sensor(kind)); }
  void request(const std::string& kind) {
    simulation.request(kind, snapshot->structure->sensors[sensor(kind)].name, true);
  }
  Pose pose(const std::string& link = "bot::body") const {
    for (std::size_t i = 0; i < snapshot->structure->links.size(); ++i) {
      if (snapshot->structure->links[i].name == link) return snapshot->link_poses[i];
    }
    throw Error("no link " + link);
  }
  Reading state(const std::string& device) const {
    const auto& devices = snapshot->structure->devices;
    for (std::size_t i = 0; i < devices.size(); ++i) {
      if (devices[i].name == device) return *snapshot->devices[i];
    }
    throw Error("no device " + device);
  }
  bool warns(const std::string& words) const {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& each) {
      return each.find(words) != std::string::npos;
    });
  }

  sim::Simulation simulation;
  std::shared_ptr<const sim::Snapshot> snapshot;
  std::vector<std::string> warnings;
};

/// Of a link of `bot` about its y axis, rad.
inline double angle(const Hall& hall, const std::string& link) {
  return to_rpy(hall.pose("bot::" + link).rotation).y();
}

inline std::vector<double> list(const Reading& reading, const std::string& field) {
  return reading.get<std::vector<double>>(field);
}

}  // namespace angen::robots
