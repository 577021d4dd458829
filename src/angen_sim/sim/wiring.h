#pragma once

#include <set>
#include <string>
#include <vector>

#include "desc/world.h"
#include "plugin/view.h"

namespace angen::sim {

/// Answers a plug-in's names from the description of its model; refs are indices into it.
class ModelWiring : public Wiring {
 public:
  ModelWiring(const desc::Model& model, std::string name, const Vec3& gravity,
              std::string sensor_link = "");

  std::string name() const override { return name_; }
  std::string model() const override { return model_.name; }
  Vec3 gravity() const override { return gravity_; }
  bool has_joint(const std::string& joint) const override;
  JointRef joint(const std::string& joint) override;
  JointLimits limits(JointRef joint) const override;
  LinkRef link(const std::string& link) override;
  std::string child_of(JointRef joint) const override;
  Vec3 anchor(JointRef joint) const override;
  double mass(LinkRef link) const override;
  LightRef light(const std::string& light) override;
  ContactRef collision(const std::string& collision) override;
  std::vector<SurfaceRef> surfaces(const std::string& visual) override;

  const std::set<std::string>& joints() const { return joints_; }  // those asked for
  /// Full names of the collisions asked for, by ContactRef.
  const std::vector<std::string>& collisions() const { return collisions_; }

 private:
  const desc::Model& model_;
  std::string name_;
  Vec3 gravity_;
  std::string sensor_link_;
  std::set<std::string> joints_;
  std::vector<std::string> collisions_;
};

}  // namespace angen::sim
