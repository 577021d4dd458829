// angen_mesh EXTENSION X Y Z <MESH_FILE >TRIANGLES: the only program that runs assimp, under limits
// of memory and CPU time, so that a damaged mesh ends it and not the simulator. It opens no file:
// not even those that a mesh names.
#include <assimp/BaseImporter.h>
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

#include "load/collada.h"
#include "load/converter.h"

namespace {

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

// Materials of an OBJ and other files that a mesh may name.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

struct Triangles {
  std::vector<aiVector3D> vertices;
  std::vector<std::uint32_t> corners;
};

// assimp turns COLLADA to y up, whatever axis the file says; this turns it to z up.
aiMatrix4x4 to_z_up() {
  aiMatrix4x4 turn;
  return aiMatrix4x4::RotationX(static_cast<ai_real>(M_PI / 2), turn);
}

void add_mesh(const aiMesh& from, const aiMatrix4x4& place, Triangles& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (unsigned i = 0; i < from.mNumVertices; ++i) to.vertices.push_back(place * from.mVertices[i]);
  const bool mirrored = place.Determinant() < 0;
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices != 3) continue;
    to.corners.push_back(first + face.mIndices[0]);
    to.corners.push_back(first + face.mIndices[mirrored ? 2 : 1]);
    to.corners.push_back(first + face.mIndices[mirrored ? 1 : 2]);
  }
}

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, Triangles& to) {
  const aiMatrix4x4 place = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    add_mesh(*scene.mMeshes[node.mMeshes[i]], place, to);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(scene, *node.mChildren[i], place, to);
}

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

Triangles triangles_of(const std::string& bytes, const std::string& extension,
                       const aiVector3D& scale) {
  if (bytes.empty()) throw Refused("cannot be read: the file is empty");
  if (extension == "dae") angen::load::check_collada(bytes);
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // which it owns
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* other = importer.GetImporter(i);
    std::set<std::string> extensions;
    other->GetExtensionList(extensions);
    if (extensions.count(extension) == 0) importer.UnregisterLoader(other);
  }
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                  aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                  aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices |
                                      aiProcess_Triangulate | aiProcess_SortByPType,
                                  extension.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string why = importer.GetErrorString();
    throw Refused(why == "std::bad_alloc" ? kTooMuchMemory : "cannot be read: " + why);
  }
  if (expanded_size(*scene, *scene->mRootNode) > angen::load::kMaxTriangles) {
    throw Refused(angen::load::kTooManyTriangles);
  }
  aiMatrix4x4 size;
  aiMatrix4x4::Scaling(scale, size);
  Triangles made;
  add_node(*scene, *scene->mRootNode, extension == "dae" ? size * to_z_up() : size, made);
  return made;
}

void write_or_end(const void* bytes, std::size_t size, std::size_t count) {
  if (std::fwrite(bytes, size, count, stdout) != count) std::exit(EXIT_FAILURE);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: angen_mesh EXTENSION X Y Z <MESH_FILE >TRIANGLES\n", stderr);
    return 2;
  }
  limit_this_process();
  std::string problem;
  try {
    const auto scale = [&](int i) { return static_cast<ai_real>(std::strtod(argv[i], nullptr)); };
    const Triangles made =
        triangles_of(read_all(STDIN_FILENO), argv[1], {scale(2), scale(3), scale(4)});
    const std::uint64_t counts[2] = {made.vertices.size(), made.corners.size() / 3};
    write_or_end(angen::load::kMeshMagic, 1, sizeof angen::load::kMeshMagic);
    write_or_end(counts, sizeof counts, 1);
    write_or_end(made.vertices.data(), sizeof(aiVector3D), made.vertices.size());
    write_or_end(made.corners.data(), sizeof(std::uint32_t), made.corners.size());
    return std::fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::bad_alloc&) {
    problem = angen::load::kTooMuchMemory;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  write_or_end(problem.data(), 1, problem.size());
  return angen::load::kMeshRefused;
}
