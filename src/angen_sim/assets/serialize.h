#pragma once

#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <type_traits>

#include "assets/bounded_input.h"
#include "core/shape.h"
#include "core/texture.h"

// cereal writes and reads converted files with these, between angen_mesh and the simulator. The
// bindings name every member of a struct: one that is added does not compile
// before it is serialized, too.
namespace cereal {

template <class A, class Scalar, int rows, int columns>
void serialize(A& a, Eigen::Matrix<Scalar, rows, columns>& v) {
  static_assert(rows > 0 && columns > 0);
  a(binary_data(v.data(), sizeof(Scalar) * rows * columns));
}

template <class A, class T>
void serialize_plain(A& a, std::vector<T>& v) {
  auto size = static_cast<std::uint64_t>(v.size());
  a(make_size_tag(size));
  if constexpr (std::is_same_v<A, angen::load::BoundedInput>) a.need(size * sizeof(T));
  v.resize(size);
  a(binary_data(v.data(), size * sizeof(T)));
}

template <class A>
void serialize(A& a, angen::TriangleMesh& v) {
  auto& [vertices, triangles] = v;
  serialize_plain(a, vertices);
  serialize_plain(a, triangles);
}

template <class A>
void serialize(A& a, angen::Texture& v) {
  auto& [width, height, bytes] = v;
  a(width, height);
  serialize_plain(a, bytes);
}

template <class A>
void serialize(A& a, angen::MeshPart& v) {
  auto& [first, color, texture] = v;
  a(first, color, texture);
}

template <class A>
void serialize(A& a, angen::MeshLook& v) {
  constexpr std::uint64_t kPartBytes = 28;  // bytes of one without a texture
  auto& [parts, corners] = v;
  auto size = static_cast<std::uint64_t>(parts.size());
  a(make_size_tag(size));
  if constexpr (std::is_same_v<A, angen::load::BoundedInput>) a.need(size * kPartBytes);
  parts.resize(size);
  for (angen::MeshPart& part : parts) a(part);
  serialize_plain(a, corners);
}

}  // namespace cereal
