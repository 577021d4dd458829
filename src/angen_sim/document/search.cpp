#include "document/search.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "core/files.h"
#include "core/lists.h"
#include "core/nearest.h"
#include "core/plugin_path.h"
#include "core/text.h"
#include "document/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

void add_path_list(const char* variable, std::vector<std::string>& to) {
  for (std::string& entry : entries_of(variable)) to.push_back(std::move(entry));
}

DefaultDialect dialect_of_variable(const char* given) {
  const std::string text = given == nullptr ? "" : given;
  if (text == "true" || text == "1") return DefaultDialect::kOwn;
  if (text == "false" || text == "0") return DefaultDialect::kGazebo;
  if (text.empty()) return DefaultDialect::kAuto;
  throw Error("ANGEN_STRICT is '" + printable(text, 80) + "'; give true or false");
}

constexpr std::size_t kShownUri = 500;  // bytes

struct Address {
  std::string scheme;  // "" or "model", "file", …
  std::string path;
};

Address split(const std::string& uri) {
  const std::size_t at = uri.find("://");
  if (at == std::string::npos) return {"", uri};
  Address address{uri.substr(0, at), uri.substr(at + 3)};
  if (address.scheme == "model" || address.scheme == "package") {  // model:///NAME is model://NAME
    address.path.erase(0, std::min(address.path.find_first_not_of('/'), address.path.size()));
  }
  return address;
}

const Packages& packages(Session& session) {
  if (!session.packages) session.packages.emplace(session.paths.packages);
  return *session.packages;
}

bool is_there(const fs::path& path) {
  std::error_code failed;
  return fs::exists(path, failed);
}

std::string folder_around(const std::string& document) {
  if (document.empty() || !is_there(document)) return "";
  return fs::absolute(document).parent_path().string();
}

// The folders in which the address is searched, in order; a full path is not changed.
std::vector<std::string> folders_for(const Address& address, const std::string& from,
                                     Session& session) {
  if (address.scheme == "model") return session.paths.models;
  if (address.scheme != "file" && !address.scheme.empty()) return {};
  std::vector<std::string> folders = session.paths.resources;
  const std::string beside = folder_around(from);
  if (!beside.empty()) folders.push_back(beside);
  return folders;
}

std::optional<std::string> existing(const fs::path& path) {
  if (!is_there(path)) return std::nullopt;
  const std::string found = fs::absolute(path).lexically_normal().string();
  return found.size() > 1 && found.back() == '/' ? found.substr(0, found.size() - 1) : found;
}

// model://PACKAGE/… and package://PACKAGE/…, and paths that packages export to Gazebo.
std::optional<std::string> find_in_packages(const Address& address, Session& session) {
  if (session.paths.packages.empty()) return std::nullopt;
  const bool is_model = address.scheme == "model";
  const Packages& known = packages(session);
  for (const std::string& folder : is_model ? known.model_folders() : known.media_folders()) {
    if (address.scheme == "package") break;
    if (auto found = existing(fs::path(folder) / address.path)) return found;
  }
  if (!is_model && address.scheme != "package") return std::nullopt;
  const std::size_t slash = address.path.find('/');
  const std::optional<std::string> folder = known.folder(address.path.substr(0, slash));
  if (!folder) return std::nullopt;
  const std::string rest = slash == std::string::npos ? "" : address.path.substr(slash + 1);
  return existing(fs::path(*folder) / rest);
}

// model://NAME/… in a document of a folder NAME, which may lie outside of the model path.
std::optional<std::string> find_in_own_model(const Address& address, const std::string& from) {
  const std::size_t slash = address.path.find('/');
  if (address.scheme != "model" || slash == std::string::npos) return std::nullopt;
  const fs::path folder = folder_around(from);
  if (folder.filename() != address.path.substr(0, slash)) return std::nullopt;
  return existing(folder / address.path.substr(slash + 1));
}

bool is_like(const std::string& name, const std::string& other) {
  constexpr std::size_t kWhole = 3, kTypingErrors = 2;
  const std::size_t errors = edits(name, other);
  return (errors <= kTypingErrors && 2 * errors < name.size()) ||
         (name.size() >= kWhole && other.find(name) != std::string::npos);
}

// The addresses of models whose names are like that of a missing one.
std::vector<std::string> models_like(const std::string& name, Session& session) {
  constexpr int kMaxEntries = 1000;
  std::set<std::string> found;
  for (const std::string& folder : session.paths.models) {
    std::error_code failed;
    fs::directory_iterator entry(folder, failed);
    for (int k = 0; !failed && k < kMaxEntries && entry != fs::directory_iterator(); ++k) {
      const fs::path model = entry->path();
      const std::string other = model.filename().string();
      if (is_like(name, other) && (is_plain_file((model / "model.sdf").string()) ||
                                   is_plain_file((model / "model.config").string()))) {
        found.insert("model://" + other);
      }
      entry.increment(failed);
    }
  }
  return {found.begin(), found.end()};
}

// For the end of an error about an address that is not found.
std::string hint(const std::string& uri, const Address& address, const std::string& what,
                 const Source& at, Session& session) {
  if (address.scheme == "model" && what == "model") {
    const std::vector<std::string> like = models_like(address.path, session);
    if (!like.empty()) return did_you_mean(uri, like);
  }
  return "searched: " + searched_places(uri, at.file, session);
}

void check_allowed(const std::string& file, const std::string& what, const Source& at,
                   Session& session) {
  if (session.allowed.holds(file, at.file)) return;
  std::error_code failed;
  throw Error(at, what + " is " + fs::weakly_canonical(file, failed).string() +
                      ", which is neither on the model or resource path, nor in a package on "
                      "ROS_PACKAGE_PATH, nor in the folder of this file; move it there, add its "
                      "folder to ANGEN_MODEL_PATH, or allow every file by allow_paths:=true "
                      "(ANGEN_ALLOW_PATHS=true)");
}

bool may_name(const std::string& path, const std::string& file, const Source& at,
              Session& session) {
  return session.allowed.holds(path, file) || session.allowed.holds(path, at.file);
}

}  // namespace

std::string models_beside(const std::string& world) {
  return world.empty() ? "" : (fs::absolute(world).parent_path() / "models").string();
}

SearchPaths SearchPaths::from_environment(const std::string& beside, bool allow_any) {
  SearchPaths paths;
  add_path_list("ANGEN_MODEL_PATH", paths.models);
  add_path_list("GAZEBO_MODEL_PATH", paths.models);
  if (!beside.empty()) paths.models.push_back(beside);
  paths.beside = beside;
  const fs::path shipped = own_folder().parent_path() / "share/angen_sim/worlds/models";
  std::error_code failed;
  paths.models.push_back(fs::weakly_canonical(shipped, failed).string());
  add_path_list("GAZEBO_RESOURCE_PATH", paths.resources);
  add_path_list("ROS_PACKAGE_PATH", paths.packages);
  paths.allow_any = allow_any || allow_paths();
  paths.default_dialect = dialect_of_variable(std::getenv("ANGEN_STRICT"));
  return paths;
}

std::optional<std::string> find_uri(const std::string& uri, const std::string& from,
                                    Session& session) {
  const Address address = split(uri);
  if (address.path.empty() || address.path.size() >= PATH_MAX) return std::nullopt;
  if (address.path[0] == '/') {
    return address.scheme.empty() || address.scheme == "file" ? existing(address.path)
                                                              : std::nullopt;
  }
  for (const std::string& folder : folders_for(address, from, session)) {
    if (auto found = existing(fs::path(folder) / address.path)) return found;
  }
  if (auto found = find_in_packages(address, session)) return found;
  return find_in_own_model(address, from);
}

std::string searched_places(const std::string& uri, const std::string& from, Session& session) {
  const Address address = split(uri);
  if (address.scheme != "model" && !address.path.empty() && address.path[0] == '/') {
    return address.path;
  }
  std::vector<std::string> places = folders_for(address, from, session);
  for (const std::string& root : session.paths.packages) {
    if (!is_in(root, places)) places.push_back(root);
  }
  if (!places.empty()) return join_names(places);
  return address.scheme == "model" ? "nowhere (ANGEN_MODEL_PATH is empty)"
                                   : "nowhere (GAZEBO_RESOURCE_PATH is empty)";
}

std::string need_uri(const std::string& uri, const std::string& what, const Source& at,
                     Session& session) {
  const Address address = split(uri);
  const std::string shown = printable(uri, kShownUri);
  if (address.path.empty()) {
    throw Error(at, "the <uri> of this " + what + " is empty; write model://NAME/… or file://…");
  }
  static const std::set<std::string> schemes = {"model", "file", "package", ""};
  if (schemes.count(address.scheme) == 0) {
    throw Error(
        at, "unknown uri '" + shown + "'; " + what + "s are read from model://NAME/… and file://…");
  }
  if (auto found = find_uri(uri, at.file, session)) {
    // The user has named it, not a document.
    if (!at.file.empty()) check_allowed(*found, what + " '" + shown + "'", at, session);
    if (what == "model" || is_plain_file(*found)) return *found;
    throw Error(at, what + " '" + shown + "' is not a regular file (" + *found + "); name one");
  }
  throw Error(at, what + " '" + shown + "' is not found; " + hint(uri, address, what, at, session));
}

int version_number(const std::string& text) {
  int minor = -1;
  if (text.compare(0, 2, "1.") != 0 || text.size() > 4) return -1;
  const char* end = text.data() + text.size();
  const auto [stop, failed] = std::from_chars(text.data() + 2, end, minor);
  return failed == std::errc{} && stop == end && minor >= 0 ? 100 + minor : -1;
}

std::string model_file(const std::string& path, const Source& at, Session& session) {
  std::error_code failed;
  if (!fs::is_directory(path, failed)) return path;
  const fs::path folder = path;
  const fs::path config = folder / "model.config";
  if (!is_there(config)) {
    if (auto found = existing(folder / "model.sdf")) {
      check_allowed(*found, "'model.sdf'", {*found, 0}, session);
      return *found;
    }
    throw Error(at, "the model folder " + path + " has no model.config; add one with <sdf>");
  }
  check_allowed(config.string(), "'model.config'", {config.string(), 0}, session);
  const Element root = parse_xml(read_file(config.string()), config.string());
  const Element* best = nullptr;
  int best_version = -1;
  for (const Element& child : root.children) {
    if (child.name != "sdf") continue;
    const std::string* version = child.attribute("version");
    const int number = version == nullptr ? 100 : version_number(*version);
    if (number > best_version && number <= 109) {
      best = &child;
      best_version = number;
    }
  }
  if (best == nullptr) {
    throw Error(root.source,
                "no <sdf version=\"1.6\">model.sdf</sdf> of a version up to 1.9 in it");
  }
  if (auto found = existing(folder / best->text)) {
    check_allowed(*found, "the file '" + best->text + "'", best->source, session);
    return *found;
  }
  throw Error(best->source, "the file '" + best->text + "' is not in " + path);
}

std::string find_beside(const std::string& name, const std::string& what, const std::string& file,
                        const Source& at, Session& session) {
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  const fs::path folder = fs::path(file).parent_path();
  std::vector<fs::path> places = {
      folder / plain, folder / "../materials/textures" / fs::path(plain).filename(),
      folder / "../textures" / fs::path(plain).filename(), folder / fs::path(plain).filename()};
  if (plain.find("://") != std::string::npos) {
    const auto found = find_uri(plain, file, session);
    places = found ? std::vector<fs::path>{*found} : std::vector<fs::path>{};
  }
  for (const fs::path& place : places) {
    std::string path = place.lexically_normal().string();
    if (!is_plain_file(path)) continue;
    if (may_name(path, file, at, session)) return path;
    std::string outside = what;
    outside.append(" ").append(printable(path, 300)).append(" of ").append(file);
    session.warn(at, outside.append(" is not read: it is outside of the allowed folders"));
    return "";
  }
  session.warn(at, what + " '" + printable(name, 300) + "' of " + file + " is not found");
  return "";
}

void make_uris_absolute(Element& element, Session& session) {
  if (element.name == "plugin") return;
  for (Element& child : element.children) {
    if (child.name != "uri") {
      make_uris_absolute(child, session);
      continue;
    }
    const Address address = split(child.text);
    if (address.path.empty() || address.path[0] == '/') continue;
    const auto found = find_uri(child.text, child.source.file, session);
    if (!found || find_uri(child.text, "", session)) continue;
    if (session.allowed.holds(*found, child.source.file)) child.text = "file://" + *found;
  }
}

}  // namespace angen::load
