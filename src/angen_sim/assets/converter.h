#pragma once

#include <cstdint>
#include <string>

#include "core/mesh_look.h"
#include "core/shape.h"
#include "core/texture.h"

/// The program angen_mesh, which alone runs assimp and reads pictures for textures: how it is
/// called and what it answers.
namespace angen::load {

constexpr std::size_t kMaxTriangles = 5'000'000;
constexpr std::uint64_t kMeshMemory = 1ULL << 30U;  // bytes of address space
constexpr unsigned kMeshCpuSeconds = 20;
constexpr int kMeshWallSeconds = 300;  // on a machine that is busy with other things

/// Its answer: this, as uint64 the counts of vertices, triangles, triangles with texture
/// coordinates and parts, three floats a vertex, three uint32 a triangle, six floats a triangle
/// with texture coordinates, and of each part its first triangle and the length of its texture's
/// name as uint32, four floats and the name. With the exit code kMeshRefused: why not.
constexpr char kMeshMagic[8] = {'a', 'n', 'g', 'm', 'e', 's', 'h', '2'};
/// The same of a picture: this, width and height as uint64, three bytes a pixel.
constexpr char kTextureMagic[8] = {'a', 'n', 'g', 't', 'e', 'x', 't', '1'};
constexpr std::uint32_t kMaxTextureSide = 512;
constexpr std::size_t kMaxTextureName = 1000;  // bytes
constexpr int kMeshRefused = 3;

constexpr char kTooManyTriangles[] = "has more than 5,000,000 triangles; simplify it";
constexpr char kTooMuchMemory[] =
    "needs more than 1 GB of memory to read; it is damaged or too large";

/// Where angen_mesh is: in angen_sim/ beside the library that this is in.
std::string mesh_program();

/// What is wanted of a mesh's file.
struct MeshRequest {
  std::string extension;  // without the dot
  Vec3 scale = Vec3::Ones();
  std::string submesh{};  // "" for all
  bool center = false;
  std::string bytes{};
  std::string materials_name{};  // of an OBJ, "" for none
  std::string materials{};       // what that file holds
};

/// The answer of `program`. Throws Error, whose message is to be read after "mesh FILE".
std::string convert_mesh(const std::string& program, const MeshRequest& request);
/// The same of a picture; after "texture FILE".
std::string convert_texture(const std::string& program, const std::string& bytes);

struct Mesh {
  TriangleMesh triangles;
  MeshLook look;
};

/// What an answer holds; these throw Error where it is none.
Mesh decode_mesh(const std::string& answer);
Texture decode_texture(const std::string& answer);

}  // namespace angen::load
