#include "plugin/library.h"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <class_loader/class_loader.hpp>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <utility>

#include "core/files.h"
#include "core/nearest.h"
#include "core/plugin_path.h"
#include "core/text.h"

namespace angen {

namespace fs = std::filesystem;

namespace {

using Plugins = std::vector<std::shared_ptr<const Plugin>>;

// class_loader logs through console_bridge; it throws its errors too.
class Silence {
 public:
  Silence() : level_(console_bridge::getLogLevel()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  }
  ~Silence() { console_bridge::setLogLevel(level_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  console_bridge::LogLevel level_;
};

// The bytes of a file, in one read: libraries have megabytes.
std::string contents(const fs::path& file) {
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(file, failed);
  std::string bytes(failed ? 0 : size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

// True when the file's type names show a plug-in registered for angen::Plugin. Read, not loaded:
// loading runs code, and a directory of libraries may hold anything.
bool registers_plugins(const fs::path& file) {
  if (file.filename() == "libangen_plugin.so") return false;  // it holds the words searched for
  const std::string bytes = contents(file);
  return bytes.find("N12class_loader4impl10MetaObjectI") != std::string::npos &&
         bytes.find("N5angen6PluginE") != std::string::npos;
}

bool is_script(const fs::path& file) { return file.extension() == ".py"; }

// Whether a file of Python registers plug-ins, by its text.
bool registers_scripts(const fs::path& file) {
  return contents(file).find("angen.register(") != std::string::npos;
}

// A second name of a library, in the same folder; libX.so of libX.so.1 is none.
bool is_alias(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_symlink(file, ignored)) return false;
  const fs::path target = fs::canonical(file, ignored);
  return target.extension() == ".so" &&
         target.parent_path() == fs::canonical(file.parent_path(), ignored);
}

std::string why_not_loadable(const std::string& path, const std::string& otherwise) {
  void* handle = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) return dlerror();
  dlclose(handle);
  return otherwise;
}

bool is_elf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  char begin[4] = {};
  return stream.read(begin, sizeof begin) && std::string(begin, sizeof begin) ==
                                                 "\x7f"
                                                 "ELF";
}

[[noreturn]] void holds_none(const std::string& file) {
  if (is_script(file)) {
    throw Error("no Angen plug-in in " + file + "; a file of Python registers one with " +
                "angen.register('" + fs::path(file).filename().string() + "', 'KIND', CLASS)");
  }
  if (!is_elf(file)) throw Error(file + " is not a shared library");
  throw Error("no Angen plug-in in " + file +
              "; a plug-in library registers one with ANGEN_REGISTER_PLUGIN");
}

bool registers(const fs::path& file) {
  return is_script(file) ? registers_scripts(file) : registers_plugins(file);
}

// Whether a path names something directly in one of the folders that are searched.
bool is_on_search_path(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::canonical(fs::absolute(file, ignored).parent_path(), ignored);
  const std::vector<fs::path> folders = plugin_path();
  return !ignored && std::any_of(folders.begin(), folders.end(), [&](const fs::path& known) {
    std::error_code missing;
    return folder == fs::canonical(known, missing) && !missing;
  });
}

// The library on the search path whose name differs by a typing error; "" = none.
std::string meant_library(const std::string& filename) {
  constexpr std::size_t kTypingError = 2;  // edits
  std::vector<std::string> known;
  for (const fs::path& folder : plugin_path()) {
    std::error_code missing;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".so" && !is_script(file)) continue;
      if (edits(filename, file.filename().string()) > kTypingError) continue;
      if (is_plain_file(file) && registers(file)) known.push_back(file.filename().string());
    }
  }
  const std::vector<std::string> nearest = nearest_names(filename, known, 1);
  return nearest.empty() ? "" : nearest.front();
}

// The file to load for `filename`, by its path or from the search path.
fs::path locate(const std::string& filename, bool any_path) {
  if (filename.find('/') != std::string::npos) {
    if (!any_path && !is_on_search_path(filename)) {
      throw Error("plug-in library " + printable(filename, 300) +
                  " is not on the plug-in path; add its folder to ANGEN_PLUGIN_PATH, or allow "
                  "every path by allow_paths:=true (ANGEN_ALLOW_PATHS=true)");
    }
    if (!is_plain_file(filename)) {
      throw Error("there is no plug-in library " + printable(filename, 300));
    }
    if (!registers(filename)) holds_none(filename);
    return fs::absolute(filename);
  }
  fs::path unsuitable;
  std::vector<std::string> searched;
  for (const fs::path& directory : plugin_path()) {
    fs::path candidate = directory / filename;
    searched.push_back(directory.string());
    if (!is_plain_file(candidate)) continue;
    if (registers(candidate)) return candidate;
    if (unsuitable.empty()) unsuitable = candidate;
  }
  if (!unsuitable.empty()) holds_none(unsuitable);
  const std::string meant = meant_library(filename);
  throw Error("plug-in library " + printable(filename, 300) + " is not found; " +
              (meant.empty()
                   ? "searched " + join_names(searched) + " (set ANGEN_PLUGIN_PATH for more)"
                   : "did you mean " + meant + "?"));
}

// The library's plug-ins, which live as long as the process, and so does their code: devices and
// sensors end after class_loader's own static objects where a static object holds them.
Plugins load(const std::string& file) {
  const Silence silence;
  Plugins plugins;
  try {
    const auto loader = std::make_shared<class_loader::ClassLoader>(file);
    for (const std::string& type : loader->getAvailableClasses<Plugin>()) {
      const std::shared_ptr<const Plugin> plugin = loader->createInstance<Plugin>(type);
      plugins.emplace_back(plugin.get(), [loader, plugin](const Plugin*) {});
    }
  } catch (const std::exception& problem) {
    throw Error("plug-in library " + file +
                " does not load: " + why_not_loadable(file, problem.what()));
  }
  if (plugins.empty()) holds_none(file);
  dlopen(file.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  return plugins;
}

std::atomic<ScriptLoader> script_loader{nullptr};

// Starts Python in this program, whose module angen calls set_script_loader().
ScriptLoader started_loader() {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (script_loader == nullptr) {
    const std::string host = own_folder() / "libangen_script.so";
    // Global: modules of Python that are libraries do not name the library of the interpreter.
    void* handle = dlopen(host.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (handle == nullptr) throw Error(std::string("Python does not start: ") + dlerror());
    const auto start =
        reinterpret_cast<void (*)(std::string&)>(dlsym(handle, "angen_start_python"));
    std::string problem = "libangen_script.so is of another version";
    if (start != nullptr) start(problem);
    if (script_loader == nullptr) throw Error("Python does not start: " + problem);
  }
  return script_loader;
}

const Plugins& loaded(const std::string& file) {
  static std::mutex mutex;
  static auto* const all = new std::map<std::string, Plugins>;  // never destroyed, see load()
  const std::lock_guard<std::mutex> lock(mutex);
  const auto known = all->find(file);
  return known != all->end() ? known->second : all->emplace(file, load(file)).first->second;
}

// The plug-ins of a file of Python. No lock is held while it runs: it may use Angen itself.
const Plugins& loaded_script(const std::string& file) {
  static std::mutex mutex;
  static auto* const all = new std::map<std::string, Plugins>;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (const auto known = all->find(file); known != all->end()) return known->second;
  }
  Plugins plugins = started_loader()(file);
  if (plugins.empty()) holds_none(file);
  const std::lock_guard<std::mutex> lock(mutex);
  return all->emplace(file, std::move(plugins)).first->second;
}

}  // namespace

void set_script_loader(ScriptLoader loader) { script_loader = loader; }

std::string find_library(const std::string& filename) {
  if (filename.find('/') != std::string::npos) {
    std::error_code ignored;
    const bool known = allow_paths() || is_on_search_path(filename);
    return known && fs::is_regular_file(filename, ignored) ? filename : "";
  }
  for (const fs::path& directory : plugin_path()) {
    std::error_code ignored;
    if (fs::is_regular_file(directory / filename, ignored)) return directory / filename;
  }
  return "";
}

struct Catalog::Impl {
  explicit Impl(bool any) : any_path(any) {}
  const bool any_path;
  std::mutex mutex;
  std::map<std::string, Plugins> libraries;  // by the requested name
  std::set<std::string> aliases;             // aliases of these names
};

Catalog::Catalog() : Catalog(allow_paths()) {}
Catalog::Catalog(bool any_path) : impl_(std::make_unique<Impl>(any_path)) {}
Catalog::~Catalog() = default;

const Plugins& Catalog::library(const std::string& filename) {
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    const auto known = impl_->libraries.find(filename);
    if (known != impl_->libraries.end()) return known->second;
  }
  if (filename.empty()) throw Error("a plug-in has no filename, must be lib….so");
  const fs::path file = locate(filename, impl_->any_path);
  const std::string real = fs::weakly_canonical(file);
  const Plugins& plugins = is_script(file) ? loaded_script(real) : loaded(real);
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  if (is_alias(file)) impl_->aliases.insert(filename);
  return impl_->libraries.emplace(filename, plugins).first->second;
}

void Catalog::add(const std::string& filename, std::shared_ptr<const Plugin> plugin) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->libraries[filename].push_back(std::move(plugin));
}

Plugins Catalog::own() {
  std::set<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(own_folder(), ignored)) {
    fs::path file = entry.path();
    if (file.extension() != ".json" || !fs::exists(file.replace_extension(".so"), ignored))
      continue;
    names.insert(file.filename());
  }
  Plugins all;
  for (const std::string& name : names) {
    for (const auto& plugin : library(name)) all.push_back(plugin);
  }
  return all;
}

std::string Catalog::library_of(const Plugin& plugin) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  for (const auto& [name, plugins] : impl_->libraries) {
    for (const auto& known : plugins) {
      if (known.get() == &plugin) return name;
    }
  }
  return "";
}

std::vector<std::string> Catalog::available() {
  std::set<std::string> names;
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    for (const auto& [name, plugins] : impl_->libraries) {
      if (impl_->aliases.count(name) == 0) names.insert(name);
    }
  }
  for (const fs::path& directory : plugin_path()) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory, ignored)) {
      const std::string name = entry.path().filename();
      const fs::path extension = entry.path().extension();
      if ((extension == ".so" || extension == ".py") && names.count(name) == 0 &&
          entry.is_regular_file(ignored) && !is_alias(entry.path()) && registers(entry.path())) {
        names.insert(name);
      }
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace angen
