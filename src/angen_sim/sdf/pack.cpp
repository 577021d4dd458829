#include "sdf/pack.h"

#include <cereal/types/memory.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>

#include "assets/serialize.h"

// As in assets/serialize.h.
namespace cereal {

template <class A>
void serialize(A& a, angen::Quat& v) {
  a(v.coeffs());
}

template <class A>
void serialize(A& a, angen::Pose& v) {
  auto& [position, rotation] = v;
  a(position, rotation);
}

template <class A>
void serialize(A& a, angen::Source& v) {
  auto& [file, line] = v;
  a(file, line);
}

template <class A>
void serialize(A& a, angen::Diagnostic& v) {
  auto& [severity, source, message] = v;
  a(severity, source, message);
}

template <class A>
void serialize(A& a, angen::Element& v) {
  auto& [name, text, attributes, children, source] = v;
  a(name, text, attributes, children, source);
}

template <class A>
void serialize(A& a, angen::HeightGrid& v) {
  auto& [columns, rows, width, depth, heights] = v;
  a(columns, rows, width, depth);
  serialize_plain(a, heights);
}

template <class A>
void serialize(A& a, angen::Photometry& v) {
  auto& [vertical, horizontal, candela] = v;
  serialize_plain(a, vertical);
  serialize_plain(a, horizontal);
  serialize_plain(a, candela);
}

template <class A>
void serialize(A& a, angen::Shape& v) {
  auto& [type, size, radius, length, mesh, heights, mesh_file, mesh_scale] = v;
  a(type, size, radius, length, mesh, heights, mesh_file, mesh_scale);
}

template <class A>
void serialize(A& a, angen::desc::Material& v) {
  auto& [diffuse, emissive, look, textures] = v;
  a(diffuse, emissive, look, textures);
}

template <class A>
void serialize(A& a, angen::desc::Friction& v) {
  auto& [mu, mu2, direction1, slip1, slip2] = v;
  a(mu, mu2, direction1, slip1, slip2);
}

template <class A>
void serialize(A& a, angen::desc::Collision& v) {
  auto& [name, pose, shape, friction, restitution, stiffness, damping, min_depth, source] = v;
  a(name, pose, shape, friction, restitution, stiffness, damping, min_depth, source);
}

template <class A>
void serialize(A& a, angen::desc::Visual& v) {
  auto& [name, pose, shape, material, temperature] = v;
  a(name, pose, shape, material, temperature);
}

template <class A>
void serialize(A& a, angen::desc::Inertial& v) {
  auto& [mass, pose, moment] = v;
  a(mass, pose, moment);
}

template <class A>
void serialize(A& a, angen::desc::Light& v) {
  auto& [name, type, pose, diffuse, intensity, range, direction, inner_angle, outer_angle, width,
         height, length, radius, half_angle, photometry, cast_shadows, level, source] = v;
  a(name, type, pose, diffuse, intensity, range, direction, inner_angle, outer_angle, width, height,
    length, radius, half_angle, photometry, cast_shadows, level, source);
}

template <class A>
void serialize(A& a, angen::desc::Sensor& v) {
  auto& [name, type, pose, update_rate, visualize, plugin, plugin_element, element, source] = v;
  a(name, type, pose, update_rate, visualize, plugin, plugin_element, element, source);
}

template <class A>
void serialize(A& a, angen::desc::Link& v) {
  auto& [name, pose, inertial, gravity, kinematic, upright, self_collide, collisions, visuals,
         sensors, lights, source] = v;
  a(name, pose, inertial, gravity, kinematic, upright, self_collide, collisions, visuals, sensors,
    lights, source);
}

template <class A>
void serialize(A& a, angen::desc::JointSafety& v) {
  auto& [soft_lower, soft_upper, k_position, k_velocity] = v;
  a(soft_lower, soft_upper, k_position, k_velocity);
}

template <class A>
void serialize(A& a, angen::desc::JointAxis& v) {
  auto& [xyz, lower, upper, effort, velocity, damping, friction, spring_stiffness, spring_reference,
         initial_position, safety] = v;
  a(xyz, lower, upper, effort, velocity, damping, friction, spring_stiffness, spring_reference,
    initial_position, safety);
}

template <class A>
void serialize(A& a, angen::desc::Joint& v) {
  auto& [name, type, parent, child, anchor, axes, lead, source] = v;
  a(name, type, parent, child, anchor, axes, lead, source);
}

template <class A>
void serialize(A& a, angen::desc::Plugin& v) {
  auto& [name, filename, element, source, is_repeatable] = v;
  a(name, filename, element, source, is_repeatable);
}

template <class A>
void serialize(A& a, angen::FloorPose& v) {
  auto& [position, yaw] = v;
  a(position, yaw);
}

template <class A>
void serialize(A& a, angen::Place& v) {
  auto& [posture, pose] = v;
  a(posture, pose);
}

template <class A>
void serialize(A& a, angen::desc::Storey& v) {
  auto& [name, number, elevation, height, source] = v;
  a(name, number, elevation, height, source);
}

template <class A>
void serialize(A& a, angen::desc::Room& v) {
  auto& [name, use, outline, holes, floor, ceiling, source] = v;
  a(name, use, outline, holes, floor, ceiling, source);
}

template <class A>
void serialize(A& a, angen::desc::Opening& v) {
  auto& [name, pose, width, height, source] = v;
  a(name, pose, width, height, source);
}

template <class A>
void serialize(A& a, angen::desc::HomeParts& v) {
  auto& [storeys, rooms, openings, thing, places] = v;
  a(storeys, rooms, openings, thing, places);
}

template <class A>
void serialize(A& a, angen::desc::HomeSite& v) {
  auto& [entrance, north, latitude, start, source] = v;
  a(entrance, north, latitude, start, source);
}

template <class A>
void serialize(A& a, angen::desc::Model& v) {
  auto& [name, pose, is_static, allow_auto_disable, self_collide, tolerant, links, joints, plugins,
         home, xml, expanded_xml, warnings, ignored, source] = v;
  a(name, pose, is_static, allow_auto_disable, self_collide, tolerant, links, joints, plugins, home,
    xml, expanded_xml, warnings, ignored, source);
}

template <class A>
void serialize(A& a, angen::desc::Physics& v) {
  auto& [step, real_time_factor, iterations, erp, cfm, contact_max_correcting_vel,
         contact_surface_layer] = v;
  a(step, real_time_factor, iterations, erp, cfm, contact_max_correcting_vel,
    contact_surface_layer);
}

template <class A>
void serialize(A& a, angen::desc::Scene& v) {
  auto& [ambient, background, shadows] = v;
  a(ambient, background, shadows);
}

template <class A>
void serialize(A& a, angen::desc::World& v) {
  auto& [name, gravity, physics, scene, ambient_temperature, tolerant, lights, models, plugins,
         home, site, warnings, ignored, xml] = v;
  a(name, gravity, physics, scene, ambient_temperature, tolerant, lights, models, plugins, home,
    site, warnings, ignored, xml);
}

}  // namespace cereal

namespace angen::load {

std::string pack(const desc::World& world) {
  std::ostringstream stream(std::ios::binary);
  cereal::BinaryOutputArchive archive(stream);
  archive(world);
  return stream.str();
}

desc::World unpack(const std::string& bytes) {
  BoundedInput archive(bytes);
  desc::World world;
  archive(world);
  return world;
}

}  // namespace angen::load
