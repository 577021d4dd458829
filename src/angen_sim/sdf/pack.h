#pragma once

#include <string>

#include "desc/world.h"

namespace angen::load {

/// A description as bytes that the same program on the same machine can read, and back. Meshes that
/// are shared stay so.
std::string pack(const desc::World& world);

/// Throws some std::exception for bytes that pack() cannot have made, and takes memory in
/// proportion to the bytes. That they are whole must be known before.
desc::World unpack(const std::string& bytes);

}  // namespace angen::load
