#include "assets/mesh.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "assets/converter.h"
#include "core/kept.h"
#include "core/text.h"
#include "document/xml.h"

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

std::string first_line_of(const std::string& bytes, const std::string& word) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    if (bytes.compare(at, word.size() + 1, word + " ") == 0) {
      return trimmed(bytes.substr(at + word.size(), end - at - word.size()));
    }
    at = end + 1;
  }
  return "";
}

std::string read_small(const std::string& path, const std::string& what, const Source& at) {
  std::error_code failed;
  if (fs::file_size(path, failed) > kMaxFileBytes || failed) {
    throw Error(at, what + " " + path + " cannot be read or is larger than 64 MB");
  }
  std::string bytes = read_file(path);
  if (bytes.compare(0, 34, "version https://git-lfs.github.com") == 0) {
    throw Error(at, what + " " + path +
                        " is a pointer of Git LFS and not the file; run git lfs pull beside it");
  }
  return bytes;
}

Mesh import(const MeshSource& source, const Source& at) {
  MeshRequest request{extension_of(source.path), source.scale, source.submesh, source.center};
  if (request.extension != "dae" && request.extension != "stl" && request.extension != "obj") {
    throw Error(at,
                "mesh " + source.path + " is of an unknown kind; known are .dae, .stl and .obj");
  }
  request.bytes = read_small(source.path, "mesh", at);
  if (!source.materials.empty()) {
    request.materials_name = fs::path(source.materials).filename().string();
    request.materials = read_small(source.materials, "materials", at);
  }
  try {
    return decode_mesh(convert_mesh(mesh_program(), request));
  } catch (const Error& problem) {
    throw Error(at, "mesh " + source.path + " " + problem.what());
  }
}

Texture import_texture(const std::string& path) {
  const std::string bytes = read_small(path, "texture", {});
  try {
    return decode_texture(convert_texture(mesh_program(), bytes));
  } catch (const Error& problem) {
    throw Error("texture " + path + " " + problem.what());
  }
}

HeightGrid read_grid(const std::string& path, const Vec3& size, const Source& at) {
  const GrayImage image = read_png(path, "heightmap", 2, at);
  HeightGrid grid{image.width, image.height, size.x(), size.y(), {}};
  grid.heights.reserve(image.values.size());
  for (const double value : image.values) {
    grid.heights.push_back(static_cast<float>(size.z() * value));
  }
  return grid;
}

std::string changed_at(const std::string& path) {
  std::error_code failed;
  return std::to_string(fs::last_write_time(path, failed).time_since_epoch().count());
}

}  // namespace

std::string materials_of(const std::string& path) {
  std::error_code failed;
  if (extension_of(path) != "obj" || fs::file_size(path, failed) > kMaxFileBytes || failed) {
    return "";
  }
  return first_line_of(read_file(path), "mtllib");
}

ReadMesh read_mesh(const MeshSource& source, const Source& at) {
  static Kept<std::string, const Mesh> kept;
  const std::string key = source.path + "|" + changed_at(source.path) + "|" + source.materials +
                          "|" + changed_at(source.materials) + "|" + scale_text(source.scale) +
                          (source.center ? "|centered|" : "|") + source.submesh;
  const std::shared_ptr<const Mesh> mesh =
      kept.get(key, [&] { return std::make_shared<Mesh>(import(source, at)); });
  return {{mesh, &mesh->triangles}, {mesh, &mesh->look}};
}

std::shared_ptr<const Texture> read_texture(const std::string& path) {
  static Kept<std::string, const Texture> kept;
  return kept.get(path + "|" + changed_at(path),
                  [&] { return std::make_shared<Texture>(import_texture(path)); });
}

GrayImage read_png(const std::string& path, const std::string& what, unsigned least,
                   const Source& at) {
  const std::string bytes = read_file(path);
  try {
    return decode_gray(convert_gray(mesh_program(), bytes, least));
  } catch (const Error& problem) {
    throw Error(at, what + " " + path + " " + problem.what());
  }
}

std::shared_ptr<const HeightGrid> read_heightmap(const std::string& path, const Vec3& size,
                                                 const Source& at) {
  static Kept<std::string, const HeightGrid> kept;
  return kept.get(path + "|" + changed_at(path) + "|" + scale_text(size),
                  [&] { return std::make_shared<HeightGrid>(read_grid(path, size, at)); });
}

}  // namespace angen::load
