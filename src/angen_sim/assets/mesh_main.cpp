// angen_mesh mesh | texture | gray LEAST <INPUT >ANSWER, as assets/converter.h describes them: the
// only program that runs assimp and reads pictures, under limits of memory and CPU time, so that a
// damaged file ends it and not the simulator. It opens no file.
#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "assets/collada.h"
#include "assets/converter.h"
#include "assets/picture.h"

namespace {

using angen::MeshPart;
using angen::TriangleMesh;
using angen::load::kMaxTextureName;
using angen::load::kTooMuchMemory;
using angen::load::Mesh;
using angen::load::MeshRequest;
using angen::load::Rejected;

constexpr const char* kUnnamed = "$ColladaAutoName$";  // assimp's, followed by a number

void limit_this_process() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto limit = [](auto resource, rlim_t soft, rlim_t hard) {
    const rlimit both{soft, hard};
    setrlimit(resource, &both);
  };
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, angen::load::kMeshCpuSeconds, angen::load::kMeshCpuSeconds + 1);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers reserve terabytes
  limit(RLIMIT_AS, angen::load::kMeshMemory, angen::load::kMeshMemory);
#endif
}

std::string read_all(int file) {
  std::string bytes;
  char piece[1U << 16U];
  for (;;) {
    const ssize_t count = read(file, piece, sizeof piece);
    if (count <= 0) return bytes;
    bytes.append(piece, static_cast<std::size_t>(count));
  }
}

/// A mesh may name files; only its materials are there.
class OneFile : public Assimp::IOSystem {
 public:
  explicit OneFile(const MeshRequest& request) : request_(request) {}
  bool Exists(const char* path) const override {
    const std::string name(path);
    const std::string& known = request_.materials_name;
    return !known.empty() && name.size() >= known.size() &&
           name.compare(name.size() - known.size(), known.size(), known) == 0;
  }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char*) override {
    if (!Exists(path)) return nullptr;
    return new Assimp::MemoryIOStream(
        reinterpret_cast<const std::uint8_t*>(request_.materials.data()),
        request_.materials.size());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  const MeshRequest& request_;
};

MeshPart part_of(const aiScene& scene, const aiMesh& mesh) {
  MeshPart part;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiColor4D color;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS) {
    for (unsigned i = 0; i < 4; ++i) part.color[i] = std::clamp(color[i], 0.0F, 1.0F);
  }
  float opacity = 1.0F;
  if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) {
    part.color[3] = std::clamp(opacity, 0.0F, 1.0F);
  }
  aiString texture;
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == aiReturn_SUCCESS) {
    part.texture.assign(texture.C_Str(), std::min<std::size_t>(texture.length, kMaxTextureName));
  }
  return part;
}

bool is_textured(const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    if (!part_of(scene, *scene.mMeshes[i]).texture.empty()) return true;
  }
  return false;
}

/// Makes triangles of the nodes. Texture coordinates come from a second reading whose vertices are
/// not joined: those of the first are joined by their places alone, whatever is painted on them.
class Expander {
 public:
  Expander(const aiScene& scene, const aiScene* unjoined, const std::string& submesh, Mesh& to)
      : scene_(scene), unjoined_(unjoined), submesh_(submesh), to_(to) {}

  /// `around`: the name of the node around it, which a node without one shares.
  void add(const aiNode& node, const aiMatrix4x4& parent, const std::string& around = "") {
    const aiMatrix4x4 place = parent * node.mTransformation;
    const std::string given = node.mName.C_Str();
    const std::string& name = given.rfind(kUnnamed, 0) == 0 ? around : given;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned number = node.mMeshes[i];
      if (is_requested(name, *scene_.mMeshes[number])) add(number, place);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], place, name);
  }
  const std::set<std::string>& names() const { return names_; }

 private:
  bool is_requested(const std::string& name, const aiMesh& mesh) {
    if (submesh_.empty()) return true;
    names_.insert(name);
    return name == submesh_ || mesh.mName.C_Str() == submesh_;
  }

  void add(unsigned number, const aiMatrix4x4& place) {
    const aiMesh& from = *scene_.mMeshes[number];
    TriangleMesh& to = to_.triangles;
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to_.look.parts.push_back(part_of(scene_, from));
    to_.look.parts.back().first = static_cast<std::uint32_t>(to.triangles.size());
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      const aiVector3D at = place * from.mVertices[i];
      to.vertices.emplace_back(at.x, at.y, at.z);
    }
    const bool mirrored = place.Determinant() < 0;
    const std::array<unsigned, 3> order = {0, mirrored ? 2U : 1U, mirrored ? 1U : 2U};
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      const aiFace& face = from.mFaces[i];
      if (face.mNumIndices != 3) continue;
      to.triangles.push_back({first + face.mIndices[order[0]], first + face.mIndices[order[1]],
                              first + face.mIndices[order[2]]});
      if (unjoined_ != nullptr) add_uv(*unjoined_->mMeshes[number], i, order);
    }
  }

  void add_uv(const aiMesh& from, unsigned face, const std::array<unsigned, 3>& order) {
    std::array<float, 6>& corners = to_.look.corners.emplace_back();
    if (!from.HasTextureCoords(0)) return;
    for (unsigned i = 0; i < 3; ++i) {
      const aiVector3D& uv = from.mTextureCoords[0][from.mFaces[face].mIndices[order[i]]];
      corners[2 * i] = uv.x;
      corners[2 * i + 1] = uv.y;
    }
  }

  const aiScene& scene_;
  const aiScene* unjoined_;
  const std::string& submesh_;
  Mesh& to_;
  std::set<std::string> names_;
};

// Faces and vertices with all instances, as add_node would make them.
std::size_t expanded_size(const aiScene& scene, const aiNode& node) {
  std::size_t size = 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    size += std::max<std::size_t>(mesh.mNumFaces, mesh.mNumVertices / 3);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) size += expanded_size(scene, *node.mChildren[i]);
  return size;
}

void prepare(Assimp::Importer& importer, const MeshRequest& request, unsigned kept) {
  importer.SetIOHandler(new OneFile(request));  // the importer owns it
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* other = importer.GetImporter(i);
    std::set<std::string> extensions;
    other->GetExtensionList(extensions);
    if (extensions.count(request.extension) == 0) importer.UnregisterLoader(other);
  }
  // Ignored, as by Gazebo: MeshLab, for one, writes Y_UP whatever the file has.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // Submeshes are known by the names of nodes, also as in Gazebo, and not by their ids.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const unsigned removed = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                           aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                           aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                           aiComponent_CAMERAS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(removed & ~kept));
}

const aiScene& scene_of(Assimp::Importer& importer, const MeshRequest& request, unsigned steps) {
  const aiScene* scene = importer.ReadFileFromMemory(
      request.bytes.data(), request.bytes.size(),
      aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType | steps,
      request.extension.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string why = importer.GetErrorString();
    throw Rejected(why == "std::bad_alloc" ? kTooMuchMemory : "cannot be read: " + why);
  }
  return *scene;
}

// True if both have the same numbers of faces.
bool match(const aiScene& one, const aiScene& other) {
  if (one.mNumMeshes != other.mNumMeshes) return false;
  for (unsigned i = 0; i < one.mNumMeshes; ++i) {
    if (one.mMeshes[i]->mNumFaces != other.mMeshes[i]->mNumFaces) return false;
  }
  return true;
}

// Moves the middle of its box to the origin.
void center(std::vector<Eigen::Vector3f>& vertices) {
  if (vertices.empty()) return;
  Eigen::Vector3f low = vertices[0], high = low;
  for (const Eigen::Vector3f& vertex : vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Eigen::Vector3f middle = (low + high) * 0.5F;
  for (Eigen::Vector3f& vertex : vertices) vertex -= middle;
}

[[noreturn]] void no_submesh(const std::string& name, const std::set<std::string>& names) {
  std::string known;
  for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
  throw Rejected("has no submesh '" + name + "'; it has " + known);
}

Mesh mesh_of(MeshRequest request) {
  if (request.bytes.empty()) throw Rejected("cannot be read: the file is empty");
  if (request.extension == "dae") {
    angen::load::check_collada(request.bytes);
    angen::load::trim_colors(request.bytes);
    angen::load::name_images(request.bytes);
  }
  Assimp::Importer importer, second;
  prepare(importer, request, 0);
  const aiScene& scene = scene_of(importer, request, aiProcess_JoinIdenticalVertices);
  if (expanded_size(scene, *scene.mRootNode) > angen::load::kMaxTriangles) {
    throw Rejected(angen::load::kTooManyTriangles);
  }
  const aiScene* unjoined = nullptr;
  if (is_textured(scene)) {
    prepare(second, request, aiComponent_TEXCOORDS);
    unjoined = &scene_of(second, request, 0);
    if (!match(scene, *unjoined)) unjoined = nullptr;
  }
  aiMatrix4x4 size;
  const Eigen::Vector3f scale = request.scale.cast<ai_real>();
  aiMatrix4x4::Scaling({scale.x(), scale.y(), scale.z()}, size);
  Mesh made;
  Expander expander(scene, unjoined, request.submesh, made);
  expander.add(*scene.mRootNode, size);
  if (made.look.parts.empty() && !request.submesh.empty()) {
    no_submesh(request.submesh, expander.names());
  }
  if (request.center) center(made.triangles.vertices);
  return made;
}

MeshRequest read_request(const std::string& input) {
  MeshRequest request;
  angen::load::BoundedInput archive(input);
  archive(request);
  return request;
}

template <class T>
void write(const T& made) {
  cereal::BinaryOutputArchive archive(std::cout);
  archive(made);
}

bool answer(const std::string& kind, const char* least) {
  const std::string input = read_all(STDIN_FILENO);
  if (kind == "mesh") write(mesh_of(read_request(input)));
  if (kind == "texture") write(angen::load::picture_of(input));
  if (kind == "gray") {
    write(angen::load::gray_picture_of(input, static_cast<unsigned>(std::atoi(least))));
  }
  return std::cout.flush().good();
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "";
  if (!((argc == 2 && (kind == "mesh" || kind == "texture")) || (argc == 3 && kind == "gray"))) {
    std::cerr << "usage: angen_mesh mesh | texture | gray LEAST <INPUT >ANSWER\n";
    return 2;
  }
  limit_this_process();
  std::ios::sync_with_stdio(false);
  std::string problem;
  try {
    return answer(kind, argv[argc - 1]) ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::bad_alloc&) {
    problem = angen::load::kTooMuchMemory;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  std::cout << problem << std::flush;
  return angen::load::kMeshRejected;
}
