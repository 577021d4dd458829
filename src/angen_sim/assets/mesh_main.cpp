// angen_mesh EXTENSION X Y Z SUBMESH CENTER [BYTES NAME] <FILES >TRIANGLES: the only program that
// runs assimp, under limits of memory and CPU time, so that a damaged mesh ends it and not the
// simulator. It opens no file: of those that a mesh names it gets NAME, with so many BYTES, after
// the mesh. angen_mesh texture <PICTURE >PIXELS does the same for pictures.
#include <assimp/BaseImporter.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "assets/collada.h"
#include "assets/converter.h"
#include "assets/picture.h"

namespace {

using angen::load::kMaxTextureName;
using angen::load::kTooMuchMemory;
using angen::load::Refused;

void limit_this_process() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto limit = [](auto resource, rlim_t soft, rlim_t hard) {
    const rlimit both{soft, hard};
    setrlimit(resource, &both);
  };
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_CPU, angen::load::kMeshCpuSeconds, angen::load::kMeshCpuSeconds + 1);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve terabytes
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

/// What came with the mesh, and how it is wanted.
struct Request {
  std::string extension;
  aiVector3D scale;
  std::string submesh;  // "" for all
  bool center = false;
  std::string bytes;
  std::string materials_name;  // of an OBJ
  std::string materials;
};

/// A mesh may name files; only its materials are there.
class OneFile : public Assimp::IOSystem {
 public:
  explicit OneFile(const Request& request) : request_(request) {}
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
  const Request& request_;
};

struct Part {
  std::uint32_t first = 0;
  float color[4] = {0.7F, 0.7F, 0.7F, 1.0F};
  std::string texture;
};

struct Triangles {
  std::vector<aiVector3D> vertices;
  std::vector<std::uint32_t> corners;
  std::vector<float> uvs;  // of each corner; empty where nothing is textured
  std::vector<Part> parts;
};

// assimp turns COLLADA to y up, whatever axis the file says; this turns it to z up.
aiMatrix4x4 to_z_up() {
  aiMatrix4x4 turn;
  return aiMatrix4x4::RotationX(static_cast<ai_real>(M_PI / 2), turn);
}

Part part_of(const aiScene& scene, const aiMesh& mesh) {
  Part part;
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
  Expander(const aiScene& scene, const aiScene* unjoined, const std::string& submesh, Triangles& to)
      : scene_(scene), unjoined_(unjoined), submesh_(submesh), to_(to) {}

  void add(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 place = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned number = node.mMeshes[i];
      if (is_wanted(node, *scene_.mMeshes[number])) add(number, place);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(*node.mChildren[i], place);
  }
  const std::set<std::string>& names() const { return names_; }

 private:
  bool is_wanted(const aiNode& node, const aiMesh& mesh) {
    if (submesh_.empty()) return true;
    names_.insert(node.mName.C_Str());
    return node.mName.C_Str() == submesh_ || mesh.mName.C_Str() == submesh_;
  }

  void add(unsigned number, const aiMatrix4x4& place) {
    const aiMesh& from = *scene_.mMeshes[number];
    const auto first = static_cast<std::uint32_t>(to_.vertices.size());
    to_.parts.push_back(part_of(scene_, from));
    to_.parts.back().first = static_cast<std::uint32_t>(to_.corners.size() / 3);
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
      to_.vertices.push_back(place * from.mVertices[i]);
    }
    const bool mirrored = place.Determinant() < 0;
    const unsigned order[3] = {0, mirrored ? 2U : 1U, mirrored ? 1U : 2U};
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
      if (from.mFaces[i].mNumIndices != 3) continue;
      for (const unsigned corner : order) {
        to_.corners.push_back(first + from.mFaces[i].mIndices[corner]);
        if (unjoined_ != nullptr) add_uv(*unjoined_->mMeshes[number], i, corner);
      }
    }
  }

  void add_uv(const aiMesh& from, unsigned face, unsigned corner) {
    aiVector3D uv;
    if (from.HasTextureCoords(0)) {
      uv = from.mTextureCoords[0][from.mFaces[face].mIndices[corner]];
    }
    to_.uvs.push_back(uv.x);
    to_.uvs.push_back(uv.y);
  }

  const aiScene& scene_;
  const aiScene* unjoined_;
  const std::string& submesh_;
  Triangles& to_;
  std::set<std::string> names_;
};

// Faces and vertices with all instances: what add_node would make.
std::size_t expanded_size(const aiScene& scene, const aiNode& node) {
  std::size_t size = 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    size += std::max<std::size_t>(mesh.mNumFaces, mesh.mNumVertices / 3);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) size += expanded_size(scene, *node.mChildren[i]);
  return size;
}

void prepare(Assimp::Importer& importer, const Request& request, unsigned kept) {
  importer.SetIOHandler(new OneFile(request));  // which it owns
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* other = importer.GetImporter(i);
    std::set<std::string> extensions;
    other->GetExtensionList(extensions);
    if (extensions.count(request.extension) == 0) importer.UnregisterLoader(other);
  }
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const unsigned removed = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                           aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                           aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                           aiComponent_CAMERAS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(removed & ~kept));
}

const aiScene& scene_of(Assimp::Importer& importer, const Request& request, unsigned steps) {
  const aiScene* scene = importer.ReadFileFromMemory(
      request.bytes.data(), request.bytes.size(),
      aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType | steps,
      request.extension.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string why = importer.GetErrorString();
    throw Refused(why == "std::bad_alloc" ? kTooMuchMemory : "cannot be read: " + why);
  }
  return *scene;
}

// Whether the faces of both are the same.
bool match(const aiScene& one, const aiScene& other) {
  if (one.mNumMeshes != other.mNumMeshes) return false;
  for (unsigned i = 0; i < one.mNumMeshes; ++i) {
    if (one.mMeshes[i]->mNumFaces != other.mMeshes[i]->mNumFaces) return false;
  }
  return true;
}

// Its box's middle to the origin.
void center(Triangles& made) {
  if (made.vertices.empty()) return;
  aiVector3D low = made.vertices[0], high = low;
  for (const aiVector3D& vertex : made.vertices) {
    for (unsigned i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], vertex[i]);
      high[i] = std::max(high[i], vertex[i]);
    }
  }
  const aiVector3D middle = (low + high) * static_cast<ai_real>(0.5);
  for (aiVector3D& vertex : made.vertices) vertex -= middle;
}

[[noreturn]] void no_submesh(const std::string& wanted, const std::set<std::string>& names) {
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  throw Refused("has no submesh '" + wanted + "'; it has " + known);
}

Triangles triangles_of(Request request) {
  if (request.bytes.empty()) throw Refused("cannot be read: the file is empty");
  if (request.extension == "dae") {
    angen::load::check_collada(request.bytes);
    angen::load::trim_colors(request.bytes);
  }
  Assimp::Importer importer, second;
  prepare(importer, request, 0);
  const aiScene& scene = scene_of(importer, request, aiProcess_JoinIdenticalVertices);
  if (expanded_size(scene, *scene.mRootNode) > angen::load::kMaxTriangles) {
    throw Refused(angen::load::kTooManyTriangles);
  }
  const aiScene* unjoined = nullptr;
  if (is_textured(scene)) {
    prepare(second, request, aiComponent_TEXCOORDS);
    unjoined = &scene_of(second, request, 0);
    if (!match(scene, *unjoined)) unjoined = nullptr;
  }
  aiMatrix4x4 size;
  aiMatrix4x4::Scaling(request.scale, size);
  Triangles made;
  Expander expander(scene, unjoined, request.submesh, made);
  expander.add(*scene.mRootNode, request.extension == "dae" ? size * to_z_up() : size);
  if (made.parts.empty() && !request.submesh.empty()) {
    no_submesh(request.submesh, expander.names());
  }
  if (request.center) center(made);
  return made;
}

void write_or_end(const void* bytes, std::size_t size, std::size_t count) {
  if (count == 0) return;  // fwrite takes no null, not even of an empty list
  if (std::fwrite(bytes, size, count, stdout) != count) std::exit(EXIT_FAILURE);
}

template <class T>
void write_all(const std::vector<T>& values) {
  write_or_end(values.data(), sizeof(T), values.size());
}

void write(const Triangles& made) {
  const std::uint64_t counts[4] = {made.vertices.size(), made.corners.size() / 3,
                                   made.uvs.size() / 6, made.parts.size()};
  write_or_end(angen::load::kMeshMagic, 1, sizeof angen::load::kMeshMagic);
  write_or_end(counts, sizeof counts, 1);
  write_all(made.vertices);
  write_all(made.corners);
  write_all(made.uvs);
  for (const Part& part : made.parts) {
    const std::uint32_t numbers[2] = {part.first, static_cast<std::uint32_t>(part.texture.size())};
    write_or_end(numbers, sizeof numbers, 1);
    write_or_end(part.color, sizeof part.color, 1);
    write_or_end(part.texture.data(), 1, part.texture.size());
  }
}

void write(const angen::Texture& made) {
  const std::uint64_t counts[2] = {made.width, made.height};
  write_or_end(angen::load::kTextureMagic, 1, sizeof angen::load::kTextureMagic);
  write_or_end(counts, sizeof counts, 1);
  write_all(made.bytes);
}

Request request_of(char** words, int count) {
  const auto scale = [&](int i) { return static_cast<ai_real>(std::strtod(words[i], nullptr)); };
  Request request{words[1],    {scale(2), scale(3), scale(4)},
                  words[5],    words[6] == std::string("1"),
                  read_all(0), "",
                  ""};
  if (count < 9) return request;
  const std::size_t size =
      std::min<std::size_t>(std::strtoull(words[7], nullptr, 10), request.bytes.size());
  request.materials_name = words[8];
  request.materials = request.bytes.substr(request.bytes.size() - size);
  request.bytes.resize(request.bytes.size() - size);
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  const bool texture = argc == 2 && argv[1] == std::string("texture");
  if (!texture && argc != 7 && argc != 9) {
    std::fputs(
        "usage: angen_mesh EXTENSION X Y Z SUBMESH CENTER [BYTES NAME] <FILES >TRIANGLES\n"
        "       angen_mesh texture <PICTURE >PIXELS\n",
        stderr);
    return 2;
  }
  limit_this_process();
  std::string problem;
  try {
    if (texture) {
      write(angen::load::picture_of(read_all(STDIN_FILENO)));
    } else {
      write(triangles_of(request_of(argv, argc)));
    }
    return std::fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::bad_alloc&) {
    problem = angen::load::kTooMuchMemory;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  write_or_end(problem.data(), 1, problem.size());
  return angen::load::kMeshRefused;
}
