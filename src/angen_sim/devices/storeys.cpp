#include "devices/storeys.h"

#include <cctype>
#include <cmath>

namespace angen::devices {

namespace {

// As the models of doors in the thesis are called, whose commands have the room in full.
std::string full_room(const std::string& name) {
  for (const char* room : {"bath", "bed", "living", "work"}) {
    if (name == room) return name + "room";
  }
  return name;
}

}  // namespace

int floor_of(double z) { return static_cast<int>(std::floor((z + 0.5) / kStoreyHeight)); }

std::string command_name(const std::string& model, const std::string& kind, double z) {
  std::string base = model;
  while (!base.empty() &&
         (std::isdigit(static_cast<unsigned char>(base.back())) != 0 || base.back() == '_')) {
    base.pop_back();
  }
  const std::string suffix = "_" + kind;
  const std::string prefix = kind + "_";
  if (base.size() > suffix.size() && base.substr(base.size() - suffix.size()) == suffix) {
    base.resize(base.size() - suffix.size());
    if (kind == "door") base = full_room(base);
  } else if (base.size() > prefix.size() && base.compare(0, prefix.size(), prefix) == 0) {
    base.erase(0, prefix.size());
  }
  if (base.empty()) base = kind;
  return base + std::to_string(floor_of(z));
}

}  // namespace angen::devices
