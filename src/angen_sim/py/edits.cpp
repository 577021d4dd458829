#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <map>
#include <tuple>

#include "py/bindings.h"

namespace angen::py {

void bind_edits(pyb::class_<World>& world) {
  const std::vector<double> none(3, 0.0);  // a Vec3 would import numpy
  world
      .def(
          "motion",
          [](const World& w, const std::string& name) {
            const sim::Motion motion = w.motion(name);
            return std::make_tuple(to_row(motion.pose), motion.linear, motion.angular);
          },
          pyb::arg("name"),
          "Of a model, model::link or model::link::collision: x y z qx qy qz qw, m/s, rad/s, in "
          "the world.")
      .def(
          "set_state",
          [](World& w, const std::string& model, const std::vector<double>& pose,
             const Vec3& linear, const Vec3& angular, const std::string& frame) {
            w.edit(sim::SetModelState{model, {frame, to_pose(pose), linear, angular}});
          },
          pyb::arg("model"), pyb::arg("pose"), pyb::arg("linear") = none,
          pyb::arg("angular") = none, pyb::arg("frame") = "",
          "Puts a model somewhere, with its present joint positions; pose is x y z roll pitch yaw.")
      .def(
          "set_joints",
          [](World& w, const std::string& model, const std::map<std::string, double>& positions) {
            sim::SetJoints edit{model, {}, {}};
            for (const auto& [joint, position] : positions) {
              edit.joints.push_back(joint);
              edit.positions.push_back(position);
            }
            w.edit(edit);
          },
          pyb::arg("model"), pyb::arg("positions"), "Joints to positions, rad or m.")
      .def(
          "push",
          [](World& w, const std::string& link, const Vec3& force, const Vec3& torque,
             double seconds) {
            w.edit(sim::PushLink{link, "", Vec3::Zero(), force, torque, {0, duration(seconds)}});
          },
          pyb::arg("link"), pyb::arg("force"), pyb::arg("torque") = none, pyb::kw_only(),
          pyb::arg("seconds"), "A force (N) at the center of mass of model::link, and a torque.");
}

}  // namespace angen::py
