#include "people/others.h"

#include <cmath>
#include <string>

#include "people/modes.h"
#include "plugin/view.h"

namespace angen::people {

namespace {

constexpr double kSameStorey = 1.0;  // m, between the feet of two people

bool is_mode(const std::string& name, Mode mode) { return name == kModes[static_cast<int>(mode)]; }

}  // namespace

std::vector<Other> others_near(const View& view, const Vec3& feet) {
  std::vector<Other> others;
  const Vec3 own = view.pose().position;
  for (const DeviceView& person : view.devices("unreachable")) {
    const Reading& state = person.state;
    if (person.pose.position == own) continue;
    const Vec3 at(state.get<double>("x"), state.get<double>("y"), state.get<double>("z"));
    if (std::abs(at.z() - feet.z()) > kSameStorey) continue;
    const double yaw = state.get<double>("yaw");
    const auto& mode = state.get<std::string>("mode");
    others.push_back({person.name,
                      at,
                      {std::cos(yaw), std::sin(yaw)},
                      state.get<double>("speed"),
                      is_mode(mode, Mode::kWalking) || is_mode(mode, Mode::kBlocked)});
  }
  return others;
}

}  // namespace angen::people
