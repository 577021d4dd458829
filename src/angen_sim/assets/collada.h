#pragma once

#include <stdexcept>
#include <string>

namespace angen::load {

/// Why a mesh is not converted, to be read after "mesh FILE".
struct Rejected : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws Rejected for a COLLADA text whose instances end nowhere or make too many nodes, or with a
/// wrong count of elements: assimp would expand them until memory ends.
void check_collada(const std::string& text);

/// Gives images without a file their id as its name: assimp would reject the whole mesh, and a
/// texture that is not found is a warning.
void name_images(std::string& text);

/// Removes blanks before the numbers of colors, where assimp accepts none.
void trim_colors(std::string& text);

}  // namespace angen::load
