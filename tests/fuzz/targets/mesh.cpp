#include "assets/mesh.h"

#include "fuzz/targets.h"
#include "sdf/geometry.h"

namespace angen::fuzz {

void mesh(const std::string& input) {
  static const MemoryFile collada(".dae");
  static const MemoryFile stl(".stl");
  static const MemoryFile wavefront(".obj");
  static const MemoryFile* const files[] = {&collada, &stl, &wavefront};
  const Split given = split(input);
  const MemoryFile& file = *files[given.choice % 3];
  file.write(given.rest);
  answered([&] {
    const auto mesh = load::read_mesh({file.path(), Vec3::Ones()}, {}).triangles;
    for (const auto& triangle : mesh->triangles) {
      for (const std::uint32_t corner : triangle) {
        require(corner < mesh->vertices.size(), "a triangle has corners that exist");
      }
    }
  });
}

}  // namespace angen::fuzz
