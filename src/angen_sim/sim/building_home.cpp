#include "sim/building_home.h"

#include <algorithm>

#include "home/solids.h"
#include "sim/building.h"

namespace angen::sim {

namespace {

using Passage = Kind::Passage;

constexpr double kWallHeight = 1.0;  // m
constexpr double kSlabArea = 1.0;    // m^2

Passage passage_of(const DeviceInstance& device) { return device.plugin->kind().passage(); }

// Whether the home module may take it for a wall: spawned sensors and furniture are none.
bool may_be_wall(const desc::Model& model) {
  if (!model.is_static) return false;
  for (const desc::Link& link : model.links) {
    for (const desc::Collision& collision : link.collisions) {
      const auto box = box_around(collision.shape, model.pose * link.pose * collision.pose);
      if (!box) return true;  // a ground
      const Vec3 size = box->bounds().sizes();
      if (size.z() >= kWallHeight || size.x() * size.y() >= kSlabArea) return true;
    }
  }
  return false;
}

// Whether the description of the home may change with that model: it says something of it, has a
// door or elevator, or may be a wall.
bool is_of_home(const LiveModel& live) {
  const auto is_passage = [](const DeviceInstance& device) {
    return passage_of(device) != Passage::kNone;
  };
  return !live.desc->home.empty() || may_be_wall(*live.desc) ||
         std::any_of(live.devices.begin(), live.devices.end(), is_passage);
}

}  // namespace

bool BuildingHome::may_have_storeys(const desc::Model& model) {
  return !model.home.rooms.empty() || !model.home.storeys.empty() || may_be_wall(model) ||
         std::any_of(model.joints.begin(), model.joints.end(),
                     [](const desc::Joint& joint) { return joint.parent == "world"; });
}

void BuildingHome::find_storeys(const Building& building,
                                const std::vector<const desc::Model*>& added) {
  std::vector<std::pair<const desc::Model*, Pose>> models;
  for (const auto& live : building.models()) {
    models.emplace_back(live->desc.get(), building.pose_of(*live));
  }
  for (const desc::Model* model : added) models.emplace_back(model, model->pose);
  storeys_ = storeys_of(world_.home, models);
}

void BuildingHome::note(const LiveModel& live) {
  if (is_of_home(live)) derived_.reset();
}

std::shared_ptr<const DerivedHome> BuildingHome::derived(const Building& building) {
  if (!derived_) derived_ = std::make_shared<const DerivedHome>(survey(building));
  return derived_;
}

HomeSurvey BuildingHome::survey(const Building& building) const {
  HomeSurvey survey;
  survey.parts = world_.home;
  survey.site = world_.site;
  survey.storeys = storeys_;
  for (const auto& live : building.models()) {
    const std::size_t number = survey.models.size();
    survey.models.push_back({live->desc, building.pose_of(*live)});
    for (const DeviceInstance& device : live->devices) {
      const Passage passage = passage_of(device);
      if (passage == Passage::kElevator) {
        survey.lifts.push_back({number, device.joint, device.name, device.device->stops()});
      } else if (passage != Passage::kNone) {
        const auto kind =
            passage == Passage::kDoor ? HomeDoor::Kind::kDoor : HomeDoor::Kind::kWindow;
        survey.leaves.push_back({number, device.joint, device.name, kind});
      }
    }
  }
  return survey;
}

}  // namespace angen::sim
