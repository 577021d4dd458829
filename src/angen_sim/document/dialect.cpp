#include "document/dialect.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "core/plugin_path.h"
#include "core/text.h"
#include "document/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

const GazeboDialect* registered = nullptr;  // by the library's static object

bool is_own(const std::string& filename) {
  if (filename.find('/') != std::string::npos) return true;  // a path of this machine
  const fs::path library = filename;
  if (library.extension() == ".py") return true;  // registered by a Python program
  if (made_for_gazebo(library.string())) return false;
  fs::path catalog = library;
  catalog.replace_extension(".json");
  const std::vector<fs::path> folders = plugin_path();
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    std::error_code failed;
    return fs::exists(folder / library, failed) && fs::exists(folder / catalog, failed);
  });
}

}  // namespace

void Dialect::report(const Error& error, Session&) const { throw Error(error); }

bool Dialect::read(const std::vector<Element*>&, Session&,
                   const std::function<void()>& read) const {
  read();
  return true;
}

const Dialect& own_dialect() {
  static const Dialect dialect;
  return dialect;
}

const GazeboDialect& gazebo_dialect(const Element& element) {
  static const std::string problem = load_library("libangen_import.so");
  if (registered != nullptr) return *registered;
  throw Error(element.source, tag_of(element) + " is read as made for Gazebo, by the package " +
                                  "angen_gazebo: " + problem +
                                  "; build that package, or source its workspace");
}

GazeboRegistration::GazeboRegistration(const GazeboDialect& dialect) { registered = &dialect; }

std::optional<bool> marked_strict(const Element& element) {
  const std::string* text = element.attribute(kStrict);
  if (text == nullptr) return std::nullopt;
  if (*text == "guessed") return false;  // in worlds that version 0.2 saved
  if (*text != "true" && *text != "false") {
    throw Error(element.source,
                std::string(kStrict) + " is '" + printable(*text) + "'; give true or false");
  }
  return *text == "true";
}

bool made_for_gazebo(const std::string& library) {
  constexpr const char* kPrefixes[] = {"libgazebo_ros_",    "libhector_gazebo_",
                                       "libroboticsgroup_", "libridgeback_ros_",
                                       "librobotnik_",      "libnexus_ros_"};
  return std::any_of(std::begin(kPrefixes), std::end(kPrefixes),
                     [&](const char* prefix) { return library.rfind(prefix, 0) == 0; });
}

bool holds_own_plugin(const Element& element) {
  if (element.name == "plugin") return is_own(element.attribute_text("filename"));
  return std::any_of(element.children.begin(), element.children.end(), holds_own_plugin);
}

}  // namespace angen::load
