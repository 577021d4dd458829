#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <map>
#include <mutex>

#include "core/text.h"
#include "load/geometry.h"
#include "load/values.h"
#include "load/xml.h"

namespace angen::load {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxTriangles = 5'000'000;

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// assimp turns COLLADA to y up, whatever axis the file says; this turns it to z up.
aiMatrix4x4 to_z_up() {
  aiMatrix4x4 turn;
  return aiMatrix4x4::RotationX(static_cast<ai_real>(M_PI / 2), turn);
}

void add_mesh(const aiMesh& from, const aiMatrix4x4& place, TriangleMesh& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const aiVector3D p = place * from.mVertices[i];
    to.vertices.emplace_back(p.x, p.y, p.z);
  }
  const bool mirrored = place.Determinant() < 0;
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;
    const std::uint32_t a = first + face.mIndices[0];
    const std::uint32_t b = first + face.mIndices[1];
    const std::uint32_t c = first + face.mIndices[2];
    to.triangles.push_back(mirrored ? std::array<std::uint32_t, 3>{a, c, b}
                                    : std::array<std::uint32_t, 3>{a, b, c});
  }
}

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
              TriangleMesh& to) {
  const aiMatrix4x4 place = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    add_mesh(*scene.mMeshes[node.mMeshes[i]], place, to);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], place, to);
}

TriangleMesh import(const std::string& path, const Vec3& scale, const Source& at) {
  const std::string extension = extension_of(path);
  if (extension != ".dae" && extension != ".stl" && extension != ".obj") {
    throw Error(at, "mesh " + path + " is of an unknown kind; known are .dae, .stl and .obj");
  }
  std::error_code failed;
  if (fs::file_size(path, failed) > kMaxFileBytes || failed) {
    throw Error(at, "mesh " + path + " cannot be read or is larger than 64 MB");
  }
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                  aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices |
                                  aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string why = importer.GetErrorString();
    throw Error(at, "mesh " + path + " cannot be read: " + why.substr(0, 200));
  }
  TriangleMesh mesh;
  aiMatrix4x4 size;
  aiMatrix4x4::Scaling(aiVector3D(static_cast<ai_real>(scale.x()), static_cast<ai_real>(scale.y()),
                                  static_cast<ai_real>(scale.z())),
                       size);
  add_node(*scene, *scene->mRootNode, extension == ".dae" ? size * to_z_up() : size, mesh);
  if (mesh.triangles.empty()) throw Error(at, "mesh " + path + " holds no triangle");
  if (mesh.triangles.size() > kMaxTriangles) {
    throw Error(at, "mesh " + path + " has more than 5,000,000 triangles; simplify it");
  }
  for (const Eigen::Vector3f& v : mesh.vertices) {
    if (!v.allFinite()) throw Error(at, "mesh " + path + " has a vertex that is not finite");
  }
  return mesh;
}

}  // namespace

std::shared_ptr<const TriangleMesh> read_mesh(const std::string& path, const Vec3& scale,
                                              const Source& at) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const TriangleMesh>> kept;
  std::error_code failed;
  const auto changed = fs::last_write_time(path, failed).time_since_epoch().count();
  const std::string key = path + "|" + std::to_string(changed) + "|" + number_text(scale.x()) +
                          "|" + number_text(scale.y()) + "|" + number_text(scale.z());
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto it = kept.begin(); it != kept.end();) {
    it = it->second.expired() ? kept.erase(it) : std::next(it);
  }
  if (auto found = kept[key].lock()) return found;
  auto mesh = std::make_shared<const TriangleMesh>(import(path, scale, at));
  kept[key] = mesh;
  return mesh;
}

}  // namespace angen::load
