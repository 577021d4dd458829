#pragma once

#include <memory>
#include <vector>

#include "sim/instance.h"
#include "sim/snapshot.h"

namespace angen::sim {

class Building;

/// The home that the models of a building make, and the storeys that are known before it is
/// derived.
class BuildingHome {
 public:
  explicit BuildingHome(const desc::World& world) : world_(world) {}

  /// By elevation; none if there are no walls.
  const std::vector<Storey>& storeys() const { return storeys_; }
  /// Whether storeys follow from it: it describes them, or rooms, or has walls, a floor or doors.
  static bool may_have_storeys(const desc::Model& model);
  /// Finds the storeys of the building's models and of those that will be added.
  void find_storeys(const Building& building, const std::vector<const desc::Model*>& added);

  /// To be called when a model has come, or leaves.
  void note(const LiveModel& live);
  /// The home of the building as it is now.
  std::shared_ptr<const DerivedHome> derived(const Building& building);

 private:
  HomeSurvey survey(const Building& building) const;

  const desc::World& world_;
  std::vector<Storey> storeys_;
  std::shared_ptr<const DerivedHome> derived_;  // null if a model has changed it since
};

}  // namespace angen::sim
