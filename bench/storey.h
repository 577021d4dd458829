#pragma once

#include <vector>

#include "core/random.h"
#include "rays/scene.h"

/// A storey of six furnished rooms of boxes: the scene of the benchmarks of `rays` and `light`.
namespace angen::bench {

struct Block {
  Shape shape;
  Pose pose;
  rays::Mobility mobility;
};

constexpr int kRoomsAcross = 3;
constexpr int kRoomsDeep = 2;
constexpr double kRoom = 4.0;     // m from wall to wall
constexpr double kCeiling = 2.6;  // m

inline Block block(const Vec3& center, const Vec3& size, double yaw, rays::Mobility mobility) {
  Block out;
  out.shape.type = Shape::Type::kBox;
  out.shape.size = size;
  out.pose = {center, from_rpy(0, 0, yaw)};
  out.mobility = mobility;
  return out;
}

inline Vec3 room_corner(int room) {
  return {kRoom * (room % kRoomsAcross), kRoom * (room / kRoomsAcross), 0.0};
}

/// Floor, ceiling, walls with a doorway 0.9 m wide in each inner one, furniture, and movers
/// (turned boxes on the floor), spread evenly over the rooms.
inline std::vector<Block> storey(int furniture_per_room, int movers) {
  using rays::Mobility;
  std::vector<Block> all;
  const Vec3 size(kRoom * kRoomsAcross, kRoom * kRoomsDeep, 0.2);
  const Vec3 middle = size / 2;
  for (const double z : {-0.1, kCeiling + 0.1}) {
    all.push_back(block({middle.x(), middle.y(), z}, size, 0.0, Mobility::kStatic));
  }
  const double half = kCeiling / 2;
  const auto wall = [&](double x, double y, double length_x, double length_y) {
    all.push_back(block({x, y, half}, {length_x, length_y, kCeiling}, 0.0, Mobility::kStatic));
  };
  for (int i = 0; i <= kRoomsAcross; ++i) {
    const bool outer = i == 0 || i == kRoomsAcross;
    for (int j = 0; j < kRoomsDeep; ++j) {
      const double y = kRoom * j, x = kRoom * i;
      wall(x, y + 0.5, 0.1, 1.0);
      wall(x, y + 2.95, 0.1, 2.1);
      if (outer) wall(x, y + 1.45, 0.1, 0.9);
    }
  }
  for (int j = 0; j <= kRoomsDeep; ++j) {
    const bool outer = j == 0 || j == kRoomsDeep;
    for (int i = 0; i < kRoomsAcross; ++i) {
      const double y = kRoom * j, x = kRoom * i;
      wall(x + 0.5, y, 1.0, 0.1);
      wall(x + 2.95, y, 2.1, 0.1);
      if (outer) wall(x + 1.45, y, 0.9, 0.1);
    }
  }
  Rng rng(1, hash_bytes("storey"), 0);
  const auto place = [&](int room, double low, double high) {
    const double x = rng.uniform(), y = rng.uniform();
    return Vec3(room_corner(room) + Vec3(0.6 + 2.8 * x, 0.6 + 2.8 * y, (low + high) / 2));
  };
  for (int room = 0; room < kRoomsAcross * kRoomsDeep; ++room) {
    for (int i = 0; i < furniture_per_room; ++i) {
      const double height = 0.4 + rng.uniform();
      all.push_back(block(place(room, 0, height), {0.6, 0.4, height}, 0.0, Mobility::kStatic));
    }
  }
  for (int i = 0; i < movers; ++i) {
    const double yaw = 6 * rng.uniform();
    const Vec3 at = place(i % (kRoomsAcross * kRoomsDeep), 0, 0.9);
    all.push_back(block(at, {0.3, 0.2, 0.9}, yaw, Mobility::kMoving));
  }
  return all;
}

inline std::vector<rays::ShapeId> fill(rays::Scene& scene, const std::vector<Block>& blocks) {
  std::vector<rays::ShapeId> ids;
  for (const Block& b : blocks) {
    ids.push_back(scene.add(b.shape, b.pose, b.mobility, Eigen::Vector3f::Constant(0.6F)));
  }
  scene.commit();
  return ids;
}

}  // namespace angen::bench
