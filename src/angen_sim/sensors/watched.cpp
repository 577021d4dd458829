#include "sensors/watched.h"

#include "plugin/wiring.h"

namespace angen::sensors {

std::vector<ContactRef> read_watched(Params& params, Wiring& wiring, const char* who) {
  const std::vector<std::string> names =
      params.texts("contact/collision", "", "collision of the sensor's link to watch");
  if (names.empty()) {
    throw params.error("contact", std::string(who) +
                                      " watches nothing, must have <contact>"
                                      "<collision>NAME</collision></contact>");
  }
  std::vector<ContactRef> watched;
  for (const std::string& name : names) {
    try {
      watched.push_back(wiring.collision(name));
    } catch (const Error& problem) {
      throw params.error("contact/collision", problem.diagnostics().front().message);
    }
  }
  return watched;
}

}  // namespace angen::sensors
