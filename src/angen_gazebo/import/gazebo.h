#pragma once

#include "document/dialect.h"
#include "document/session.h"

namespace angen::load {

constexpr char kFtSensor[] = "libgazebo_ros_ft_sensor.so";

/// The joint, without its model's name, that the <plugin> of a force-torque sensor measures.
std::string measured_joint(const Element& plugin, const std::string& model);

/// Throws Error for a URDF <robot> whose links, joints or numbers are not as they must be, and for
/// one so large or deep that libsdformat would take minutes.
void check_robot(const Element& robot);

/// The dialect of documents made for Gazebo; one file for each group of its questions.
class Gazebo : public GazeboDialect {
 public:
  void report(const Error& error, Session& session) const override;
  bool read(const std::vector<Element*>& roots, Session& session,
            const std::function<void()>& read) const override;
  bool corrects_values() const override { return true; }
  bool names_joints_apart() const override { return true; }
  void correct_names(Element& sdf, int version, Session& session) const override;
  void complete(desc::Model& model) const override;
  void complete(desc::World& world) const override;

  Element convert_urdf(Element robot, Session& session) const override;
  std::vector<Element> models_of(const Element& part) const override;
  std::optional<OgreMaterial> ogre_material(const std::string& path, const Element& uri,
                                            const Element& script, Session& session) const override;
  void prepare_plugins(desc::Model& model) const override;
};

}  // namespace angen::load
