#pragma once

#include <cstdint>
#include <string>

#include "core/shape.h"

/// The program angen_mesh, which alone runs assimp: how it is called and what it answers.
namespace angen::load {

constexpr std::size_t kMaxTriangles = 5'000'000;
constexpr std::uint64_t kMeshMemory = 1ULL << 30U;  // bytes of address space
constexpr unsigned kMeshCpuSeconds = 20;
constexpr int kMeshWallSeconds = 300;  // on a machine that is busy with other things

/// Its answer: this, the counts of vertices and triangles as uint64, three floats a vertex and
/// three uint32 a triangle. With the exit code kMeshRefused: why not.
constexpr char kMeshMagic[8] = {'a', 'n', 'g', 'm', 'e', 's', 'h', '1'};
constexpr int kMeshRefused = 3;

constexpr char kTooManyTriangles[] = "has more than 5,000,000 triangles; simplify it";
constexpr char kTooMuchMemory[] =
    "needs more than 1 GB of memory to read; it is damaged or too large";

/// Where angen_mesh is: in angen_sim/ beside the library that this is in.
std::string mesh_program();

/// The answer of `program` to a mesh file's bytes (extension without the dot). Throws Error, whose
/// message is to be read after "mesh FILE".
std::string convert_mesh(const std::string& program, const std::string& bytes,
                         const std::string& extension, const Vec3& scale);

/// The mesh in an answer; throws Error where it is none.
TriangleMesh decode_mesh(const std::string& answer);

}  // namespace angen::load
