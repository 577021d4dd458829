#include "devices/part_names.h"

#include <cctype>

namespace angen::devices {

namespace {

// Names of the models of doors in the thesis, whose commands have the room in full.
std::string full_room(const std::string& name) {
  for (const char* room : {"bath", "bed", "living", "work"}) {
    if (name == room) return name + "room";
  }
  return name;
}

}  // namespace

std::string command_name(const std::string& model, const std::string& kind, int floor) {
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
  return base + std::to_string(floor);
}

std::string command_name(const ModelInfo& model, const std::string& kind) {
  return command_name(model.name, kind, floor_at(model.storeys, model.pose.position.z()));
}

std::string leaf_name(const std::string& part, const std::string& kind, int floor) {
  const std::string word = "_" + kind;
  const std::size_t at = part.find(word);
  const std::size_t after = at + word.size();
  if (at == std::string::npos || at == 0) return "";
  if (after < part.size() && std::isalpha(static_cast<unsigned char>(part[after])) != 0) return "";
  std::string room = part.substr(0, at);
  const std::size_t mark = room.rfind("_f");
  const std::size_t digits = mark + 2;
  if (mark != std::string::npos && mark > 0 && digits < room.size() && room.size() < digits + 4 &&
      room.find_first_not_of("0123456789", digits) == std::string::npos) {
    floor = std::stoi(room.substr(digits));
    room.resize(mark);
  }
  return command_name(room + word, kind, floor);
}

}  // namespace angen::devices
