#include <cctype>
#include <filesystem>
#include <map>
#include <mutex>

#include "core/random.h"
#include "core/text.h"
#include "load/cache.h"
#include "load/converter.h"
#include "load/geometry.h"
#include "load/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

// Without its dot.
std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension.empty() ? extension : extension.substr(1);
}

std::string scale_text(const Vec3& scale) {
  return number_text(scale.x()) + "|" + number_text(scale.y()) + "|" + number_text(scale.z());
}

TriangleMesh import(const std::string& path, const Vec3& scale, const Source& at) {
  const std::string extension = extension_of(path);
  if (extension != "dae" && extension != "stl" && extension != "obj") {
    throw Error(at, "mesh " + path + " is of an unknown kind; known are .dae, .stl and .obj");
  }
  std::error_code failed;
  if (fs::file_size(path, failed) > kMaxFileBytes || failed) {
    throw Error(at, "mesh " + path + " cannot be read or is larger than 64 MB");
  }
  const std::string bytes = read_file(path);
  try {
    const std::string program = mesh_program();
    const std::string key = extension + "|" + scale_text(scale) + "|" +
                            std::to_string(bytes.size()) + "|" + std::to_string(hash_bytes(bytes));
    if (const std::optional<std::string> kept = recall_mesh(key)) return decode_mesh(*kept);
    const std::string answer = convert_mesh(program, bytes, extension, scale);
    TriangleMesh mesh = decode_mesh(answer);
    keep_mesh(key, answer);
    return mesh;
  } catch (const Error& problem) {
    throw Error(at, "mesh " + path + " " + problem.what());
  }
}

/// The meshes that somebody uses, by file and scale.
struct Kept {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<const TriangleMesh>> meshes;
};

}  // namespace

std::shared_ptr<const TriangleMesh> read_mesh(const std::string& path, const Vec3& scale,
                                              const Source& at) {
  static Kept kept;
  std::error_code failed;
  const auto changed = fs::last_write_time(path, failed).time_since_epoch().count();
  const std::string key = path + "|" + std::to_string(changed) + "|" + scale_text(scale);
  {
    const std::lock_guard<std::mutex> lock(kept.mutex);
    for (auto it = kept.meshes.begin(); it != kept.meshes.end();) {
      it = it->second.expired() ? kept.meshes.erase(it) : std::next(it);
    }
    const auto found = kept.meshes.find(key);
    if (found != kept.meshes.end()) {
      if (auto mesh = found->second.lock()) return mesh;
    }
  }
  auto mesh = std::make_shared<const TriangleMesh>(import(path, scale, at));
  const std::lock_guard<std::mutex> lock(kept.mutex);
  if (auto meanwhile = kept.meshes[key].lock()) return meanwhile;
  kept.meshes[key] = mesh;
  return mesh;
}

}  // namespace angen::load
