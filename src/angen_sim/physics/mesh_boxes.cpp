#include "physics/mesh_boxes.h"

#include <algorithm>
#include <utility>

namespace angen::physics {

namespace {

constexpr std::ptrdiff_t kInLeaf = 4;  // triangles

}  // namespace

MeshBoxes::MeshBoxes(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    Triangle triangle;
    for (const std::uint32_t corner : corners) {
      triangle.box.extend(mesh.vertices[corner].cast<double>());
    }
    triangle.center = triangle.box.center();
    triangles.push_back(triangle);
  }
  nodes_.reserve(triangles.size());
  add(triangles.begin(), triangles.end());
}

void MeshBoxes::add(std::vector<Triangle>::iterator begin, std::vector<Triangle>::iterator end) {
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centers;
  for (auto at = begin; at != end; ++at) {
    box.extend(at->box);
    centers.extend(at->center);
  }
  const std::size_t index = nodes_.size();
  nodes_.push_back({box.center(), 0.5 * box.sizes(), 0, 0});
  if (end - begin <= kInLeaf) {
    nodes_[index].count = static_cast<std::size_t>(end - begin);
    return;
  }
  Eigen::Index axis = 0;
  centers.sizes().maxCoeff(&axis);
  const auto middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [axis](const Triangle& one, const Triangle& other) {
    return one.center[axis] < other.center[axis];
  });
  add(begin, middle);
  nodes_[index].next = nodes_.size();
  add(middle, end);
}

Eigen::AlignedBox3d MeshBoxes::bounds() const {
  const Node& all = nodes_.front();
  return {Vec3(all.center - all.half), Vec3(all.center + all.half)};
}

std::size_t MeshBoxes::tests(const MeshBoxes& a, const Pose& a_at, const MeshBoxes& b,
                             const Pose& b_at, std::size_t most) {
  const Pose to_a = a_at.inverse() * b_at;
  const Eigen::Matrix3d turn = to_a.rotation.toRotationMatrix();
  const Eigen::Matrix3d spread = turn.cwiseAbs();
  const auto apart = [&](const Node& one, const Node& other) {
    const Vec3 way = turn * other.center + to_a.position - one.center;
    const Vec3 along_one = one.half + spread * other.half;
    if ((way.cwiseAbs().array() > along_one.array()).any()) return true;
    const Vec3 along_other = other.half + spread.transpose() * one.half;
    return ((turn.transpose() * way).cwiseAbs().array() > along_other.array()).any();
  };
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, 0}};
  std::size_t tests = 0;
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const Node& one = a.nodes_[i];
    const Node& other = b.nodes_[j];
    tests += 1;
    if (!apart(one, other)) {
      if (one.count > 0 && other.count > 0) {
        tests += one.count * other.count;
      } else if (other.count > 0 || (one.count == 0 && one.half.sum() > other.half.sum())) {
        open.insert(open.end(), {{i + 1, j}, {one.next, j}});
      } else {
        open.insert(open.end(), {{i, j + 1}, {i, other.next}});
      }
    }
    if (tests >= most) return most;
  }
  return tests;
}

}  // namespace angen::physics
