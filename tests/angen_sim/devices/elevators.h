#pragma once

#include <cstdint>
#include <string>

#include "angen_sim/devices/models.h"
#include "angen_sim/devices/rig.h"

/// An elevator on a bench, and what its tests ask of it.
namespace angen::test {

inline Rig& add_elevator(Bench& bench, double cabin_mass = 400.0,
                         const Parameters& parameters = {}) {
  return bench.add(elevator(cabin_mass), "libros_plugin.so", "elevator", parameters);
}

inline double height(const Rig& rig) { return rig.at("lift").position; }

inline std::string door_mode(const Rig& rig) { return rig.state().get<std::string>("door_mode"); }

inline std::int64_t floor_of(const Rig& rig) { return rig.state().get<std::int64_t>("floor"); }

inline bool standing_open(const Rig& rig, int floor) {
  return rig.mode() == "IDLE" && floor_of(rig) == floor && door_mode(rig) == "OPEN";
}

}  // namespace angen::test
