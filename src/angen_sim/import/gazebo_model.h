#pragma once

#include "desc/world.h"

/// Defaults that robots made for Gazebo rely on.
namespace angen::load {

constexpr char kFtSensor[] = "libgazebo_ros_ft_sensor.so";

/// The joint, without its model's name, that the <plugin> of a force-torque sensor measures.
std::string measured_joint(const Element& plugin, const std::string& model);

/// Fixed joints that a force-torque sensor measures become hinges that their stops hold: links on
/// fixed joints are one body.
void hold_measured_joints(desc::Model& model);

/// Topic and frame of bumpers that give none, as Gazebo has them; of a tolerant model.
void add_bumper_defaults(desc::Model& model);

}  // namespace angen::load
