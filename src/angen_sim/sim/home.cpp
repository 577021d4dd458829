#include "sim/home.h"

#include <algorithm>

#include "sim/building.h"

namespace angen::sim {

namespace {

using Passage = Kind::Passage;

Passage passage_of(const DeviceInstance& device) { return device.plugin->kind().passage(); }

}  // namespace

bool is_of_home(const LiveModel& live) {
  const auto is_passage = [](const DeviceInstance& device) {
    return passage_of(device) != Passage::kNone;
  };
  return live.desc->is_static || !live.desc->home.empty() ||
         std::any_of(live.devices.begin(), live.devices.end(), is_passage);
}

HomeSurvey Building::survey_home() const {
  HomeSurvey survey;
  survey.parts = world_.home;
  survey.site = world_.site;
  for (const auto& live : models_) {
    const std::size_t number = survey.models.size();
    survey.models.push_back({live->desc, pose_of(*live)});
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
