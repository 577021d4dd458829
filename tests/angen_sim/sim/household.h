#pragma once

#include <string>

#include "angen_sim/sim/room.h"

/// Worlds with a door, a lamp, a person and a home's sensors.
namespace angen::sim {

inline const std::string kDoor = R"(<model name='hall_door'><pose>-2 2 0 0 0 0</pose>
  <link name='base'><pose>0 0 1 0 0 0</pose><inertial><mass>5</mass></inertial></link>
  <link name='leaf'><pose>0.4 0 1 0 0 0</pose><inertial><mass>20</mass><inertia><ixx>7</ixx>
    <iyy>8</iyy><izz>1.1</izz></inertia></inertial><collision name='c'><geometry><box>
    <size>0.8 0.04 1.9</size></box></geometry></collision></link>
  <joint name='fix' type='fixed'><parent>world</parent><child>base</child></joint>
  <joint name='hinge' type='revolute'><parent>base</parent><child>leaf</child>
    <pose>-0.4 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz><limit><lower>-1.57</lower>
    <upper>0.001</upper></limit></axis></joint>
  <plugin name='d' filename='libdoor_world_plugin.so'/></model>)";

inline const std::string kLamp =
    R"(<model name='hall_lamp'><static>true</static><pose>0 0 2.5 0 0 0</pose>
  <link name='link'><light name='l' type='point'><diffuse>1 1 1 1</diffuse></light></link>
  <plugin name='l' filename='libros_plugin.so'/></model>)";

inline const std::string kPerson =
    R"(<actor name='person'><script><loop>true</loop><trajectory id='0'
  type='walk'><waypoint><time>0</time><pose>-1.5 -2 0 0 0 0</pose></waypoint>
  <waypoint><time>7</time><pose>-1.5 -2 0 0 0 1</pose></waypoint>
  <waypoint><time>9</time><pose>0.5 -2 0 0 0 0</pose></waypoint>
  <waypoint><time>20</time><pose>0.5 -2 0 0 0 0</pose></waypoint>
  <waypoint><time>22</time><pose>-1.5 -2 0 0 0 0</pose></waypoint></trajectory></script></actor>)";

inline std::string text_of_world() {
  std::string text = room();
  const std::string lux =
      "<sensor name='lux' type='camera'><update_rate>1</update_rate><camera><image><width>1</width>"
      "<height>1</height></image></camera><plugin name='l' filename="
      "'libluminosity_sensor_controller.so'><noise_stddev>0.01</noise_stddev></plugin></sensor>";
  const std::string bumper =
      "<sensor name='bump' type='contact'><update_rate>5</update_rate><contact><collision>c"
      "</collision></contact><plugin name='b' filename='libgazebo_ros_bumper.so'>"
      "<noise_stddev>0.1</noise_stddev></plugin></sensor>";
  const std::string more =
      kDoor + kLamp + kPerson +
      body("lux", "<box><size>0.05 0.05 0.05</size></box>", "1 1 2 0 1.57 0", true, lux) +
      body("pad", "<box><size>0.5 0.5 0.1</size></box>", "-1 -0.5 0.3 0 0 0", false, bumper);
  const std::string end = "</world></sdf>";
  return text.replace(text.find(end), end.size(), more + end);
}

inline std::string custom(const std::string& name, const std::string& library,
                          const std::string& more) {
  return "<sensor name='" + name + "' type='custom'><update_rate>1</update_rate><plugin name='p' " +
         "filename='lib" + library + ".so'>" + more + "</plugin></sensor>";
}

/// Devices that change by themselves, and sensors of their reports.
inline std::string text_of_household() {
  const std::string none = "<box><size>0.05 0.05 0.05</size></box>";
  const std::string mat =
      "<sensor name='mat' type='contact'><contact><collision>c</collision></contact>"
      "<plugin name='m' filename='libpressure_mat.so'><threshold>0.5</threshold></plugin></sensor>";
  const std::string sensors =
      custom("t", "temperature_sensor", "") +
      custom("h", "humidity_sensor", "<noise_stddev>3</noise_stddev>") +
      custom("noisy", "temperature_sensor", "<noise_stddev>0.2</noise_stddev>") +
      custom("tags", "rfid_reader", "<beam_angle>6.2</beam_angle>") +
      custom("meter", "smart_plug", "<load>heater/stove</load><noise_stddev>0.5</noise_stddev>") +
      custom("other", "smart_plug", "<load>lamp/hall0</load><noise_stddev>0.1</noise_stddev>") +
      ray_sensor("near", "libgazebo_ros_range.so", 10, 0.01);
  std::string door = kDoor;
  const std::string base = "</mass></inertial></link>";
  door.insert(door.find(base) + base.size() - 7,
              "<sensor name='reed' type='custom'><pose>0.8 0 0.01 0 0 0</pose><plugin name='r' "
              "filename='libreed_contact.so'><magnet_link>leaf</magnet_link>"
              "<magnet>0.4 0 0</magnet></plugin></sensor>");
  return in_world(
      door + kLamp + kPerson +
      "<model name='flat'><static>true</static><link name='l'/>"
      "<angen:room name='a'><angen:polygon>-3 -3 3 -3 3 2 -3 2</angen:polygon></angen:room>"
      "<angen:room name='b'><angen:polygon>-3 2 3 2 3 4 -3 4</angen:polygon></angen:room>"
      "<plugin name='c' filename='libroom_climate.so'/></model><model "
      "name='stove'><static>true</static><link name='l'/>"
      "<plugin name='h' filename='libheater.so'/><plugin name='t' filename='librfid_tag.so'/>"
      "<plugin name='b' filename='librobot_battery.so'/></model>" +
      body("it", none, "-0.5 -2 0.8 0 0 0", true, sensors) +
      body("floor", "<box><size>9 9 0.2</size></box>", "0 0 -0.1 0 0 0", true, mat) +
      body("brick", "<box><size>0.4 0.2 0.6</size></box>", "1 0 1.2 0 0 0", false));
}

}  // namespace angen::sim
