#pragma once

#include <cstdint>
#include <string>

#include "assets/mesh.h"
#include "assets/serialize.h"

/// The program angen_mesh, which alone runs assimp and reads pictures: its arguments and what it
/// answers. Its input is a MeshRequest, or a picture's bytes; its answer a Mesh, a Texture or a
/// GrayImage, as assets/serialize.h writes them, or with the exit code kMeshRejected the problem.
namespace angen::load {

constexpr std::size_t kMaxTriangles = 5'000'000;
constexpr std::uint64_t kMeshMemory = 1ULL << 30U;  // bytes of address space
constexpr unsigned kMeshCpuSeconds = 20;
constexpr int kMeshWallSeconds = 300;  // on a machine that is busy with other things

constexpr std::uint32_t kMaxTextureSide = 512;
constexpr std::size_t kMaxTextureName = 1000;  // bytes
constexpr int kMeshRejected = 3;

constexpr char kTooManyTriangles[] = "has more than 5,000,000 triangles; simplify it";
constexpr char kTooMuchMemory[] =
    "needs more than 1 GB of memory to read; it is damaged or too large";

/// The path of angen_mesh: in angen_sim/ in the folder of Angen's libraries.
std::string mesh_program();

/// A mesh's file, and how to convert it.
struct MeshRequest {
  std::string extension;  // without the dot
  Vec3 scale = Vec3::Ones();
  std::string submesh{};  // "" for all
  bool center = false;
  std::string bytes{};
  std::string materials_name{};  // an OBJ's, "" for none
  std::string materials{};       // the contents of that file
};

struct Mesh {
  TriangleMesh triangles;
  MeshLook look;
};

/// Answers of `program`, which throw Error: for a mesh, its message is to be read after "mesh
/// FILE".
std::string convert_mesh(const std::string& program, const MeshRequest& request);
/// Its answer for a picture; the message is to be read after "texture FILE".
std::string convert_texture(const std::string& program, const std::string& bytes);
/// Its answer for a PNG of at least `least` pixels a side.
std::string convert_gray(const std::string& program, const std::string& bytes, unsigned least);

/// Decode an answer; throw Error if it is damaged.
Mesh decode_mesh(const std::string& answer);
Texture decode_texture(const std::string& answer);
GrayImage decode_gray(const std::string& answer);

}  // namespace angen::load

namespace cereal {

template <class A>
void serialize(A& a, angen::load::MeshRequest& v) {
  auto& [extension, scale, submesh, center, bytes, materials_name, materials] = v;
  a(extension, scale, submesh, center, bytes, materials_name, materials);
}

template <class A>
void serialize(A& a, angen::load::Mesh& v) {
  auto& [triangles, look] = v;
  a(triangles, look);
}

template <class A>
void serialize(A& a, angen::load::GrayImage& v) {
  auto& [width, height, values] = v;
  a(width, height);
  serialize_plain(a, values);
}

}  // namespace cereal
