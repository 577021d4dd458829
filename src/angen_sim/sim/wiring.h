#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "desc/world.h"
#include "home/survey.h"
#include "plugin/plugin.h"
#include "plugin/wiring.h"

namespace angen::sim {

/// Answers a plug-in's names from the description of its model; refs are indices into it.
class ModelWiring : public Wiring {
 public:
  ModelWiring(const desc::Model& model, const std::vector<Storey>& storeys, std::string name,
              std::string sensor_link = "");

  std::string name() const override { return name_; }
  std::string model() const override { return model_.name; }
  std::vector<Room> rooms() const override { return rooms_of(model_.home, Pose{}, model_.name); }
  std::vector<double> floors() const override;
  bool has_joint(const std::string& joint) const override;
  std::vector<std::string> joint_names() const override;
  JointRef joint(const std::string& joint) override;
  JointLimits limits(JointRef joint) const override;
  LinkRef link(const std::string& link) override;
  bool is_fixed(JointRef joint) const override;
  std::string child_of(JointRef joint) const override;
  Vec3 anchor(JointRef joint) const override;
  Vec3 axis(JointRef joint) const override;
  double mass(LinkRef link) const override;
  Vec3 center(LinkRef link) const override;
  LightRef light(const std::string& light) override;
  std::vector<std::string> collision_names(LinkRef link) const override;
  ContactRef collision(LinkRef link, const std::string& collision) override;
  std::optional<SensorPart> sensor(const std::string& sensor) override;
  std::vector<SurfaceRef> surfaces(const std::string& visual) override;
  void anatomy(LinkRef link, Anatomy anatomy) override;
  void leads(JointRef joint, double longest_step) override;

  const std::set<std::string>& joints() const { return joints_; }  // requested joints
  const std::set<int>& lights() const { return lights_; }          // by LightRef
  /// Full names of the requested collisions, by ContactRef.
  const std::vector<std::string>& collisions() const { return collisions_; }
  const std::set<std::string>& sensors() const { return sensors_; }  // requested sensors
  /// The link whose anatomy was declared, and that; -1: none was.
  const std::pair<int, Anatomy>& body() const { return body_; }
  /// The joints that are led, by JointRef, with the longest step of each (s).
  const std::vector<std::pair<int, double>>& led() const { return led_; }

 private:
  const desc::Joint& at(JointRef joint) const {
    return model_.joints.at(static_cast<std::size_t>(joint.index));
  }
  const desc::Link& at(LinkRef link) const {
    return model_.links.at(static_cast<std::size_t>(link.index));
  }

  const desc::Model& model_;
  const std::vector<Storey>& storeys_;
  std::string name_;
  std::string sensor_link_;
  std::set<std::string> joints_;
  std::set<int> lights_;
  std::vector<std::string> collisions_;
  std::set<std::string> sensors_;
  std::pair<int, Anatomy> body_{-1, {}};
  std::vector<std::pair<int, double>> led_;
};

}  // namespace angen::sim
