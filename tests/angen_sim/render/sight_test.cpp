#include "render/sight.h"

#include <gtest/gtest.h>

#include <array>

#include "core/random.h"
#include "render/shade.h"
#include "scene_view.h"

namespace angen::render {
namespace {

/// A room of walls, furniture that stands, and boxes and balls that move.
class Room {
 public:
  Room() {
    Rng rng(1, hash_bytes("room"), 0);
    still_.push_back(body(box(8.0, 8.0, 0.2), at(0.0, 0.0, -0.1)));
    still_.push_back(body(box(8.0, 8.0, 0.2), at(0.0, 0.0, 2.7)));
    still_.push_back(body(box(0.1, 5.0, 2.6), at(0.5, -1.5, 1.3)));
    still_.push_back(body(box(5.0, 0.1, 2.6), at(-1.5, 0.5, 1.3)));
    for (int i = 0; i < 10; ++i) {
      still_.push_back(body(box(0.6, 0.4, 0.8), {place(rng, 0.4), from_rpy(0, 0, i % 3)}));
    }
    for (int i = 0; i < 12; ++i) {
      const Shape shape = i % 2 == 0 ? box(0.3, 0.3, 0.9) : round(Shape::Type::kSphere, 0.2);
      const Body mover = body(shape, Pose{});
      auto patch = std::make_unique<Patch>(std::vector<std::pair<const Body*, Pose>>{{&mover, {}}});
      instances_.add(std::move(patch), {place(rng, 0.5), from_rpy(0.1 * i, 0.0, i)}, i % 5 != 0);
    }
    std::vector<std::pair<const Body*, Pose>> placed;
    for (const Body& each : still_) placed.emplace_back(&each, each.pose);
    instances_.set_fixed(std::make_unique<Patch>(placed));
    instances_.commit();
  }

  static Vec3 place(Rng& rng, double z) {
    return {7.0 * rng.uniform() - 3.5, 7.0 * rng.uniform() - 3.5, z};
  }

  bool sees(const Eigen::Vector3f& from, const Eigen::Vector3f& to, const Among& among = {}) const {
    alignas(64) int wanted[kLanes] = {-1};
    alignas(64) RTCRay16 rays{};
    rays.org_x[0] = from.x();
    rays.org_y[0] = from.y();
    rays.org_z[0] = from.z();
    rays.dir_x[0] = to.x() - from.x();
    rays.dir_y[0] = to.y() - from.y();
    rays.dir_z[0] = to.z() - from.z();
    rays.tfar[0] = 1.0F;
    rays.mask[0] = UINT32_MAX;
    instances_.find_occluded(wanted, among, rays);
    return rays.tfar[0] >= 0.0F;
  }

  const Instances& instances() const { return instances_; }

 private:
  std::vector<Body> still_;
  Instances instances_;
};

Box points_on_a_surface(Rng& rng) {
  const Eigen::Vector3f low = Room::place(rng, 2.5 * rng.uniform()).cast<float>();
  Eigen::Vector3f size = 0.4F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cast<float>();
  size[static_cast<Eigen::Index>(rng.next() % 3)] = 0.0F;
  return {low, low + size};
}

/// Expects that some rays from the points to the lamp are as the answer says.
void expect_seen(const Room& room, const light::Lit& lamp, const Box& points, Sight sight,
                 Rng& rng) {
  for (int k = 0; k < 20 && sight != Sight::kSome; ++k) {
    const Eigen::Vector3f share = Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cast<float>();
    const Eigen::Vector3f from = points.min() + share.cwiseProduct(points.sizes());
    const Eigen::Vector3f to = lamp.lamp.pose.position.cast<float>();
    ASSERT_EQ(room.sees(from, to), sight == Sight::kAll);
  }
}

/// Whether rays less than 0.1 mm beside that one have another answer.
bool passes_an_edge(const Room& room, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  int seen = 0;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3f corner(k & 1 ? 1.0F : -1.0F, k & 2 ? 1.0F : -1.0F, k & 4 ? 1.0F : -1.0F);
    seen += room.sees(from + 5e-5F * corner, to) ? 1 : 0;
  }
  return seen != 0 && seen != 8;
}

/// Expects that rays from the points are hidden by the obstacles or not at all.
void expect_hidden_by(const Room& room, const light::Lit& lamp, const Box& points,
                      const Obstacles& obstacles, Rng& rng) {
  const Eigen::Vector3f to = lamp.lamp.pose.position.cast<float>();
  Columns from;
  int known[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const Eigen::Vector3f share = Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cast<float>();
    from.set(i, points.min() + share.cwiseProduct(points.sizes()));
    known[i] = -1;
  }
  drop_hidden(obstacles.faces, to, from, known);
  for (int i = 0; i < kLanes; ++i) {
    const bool seen = room.sees(from[i], to);
    const bool is_lit = known[i] != 0 && room.sees(from[i], to, obstacles.unknown);
    ASSERT_TRUE(is_lit == seen || passes_an_edge(room, from[i], to));
  }
}

Box part_of(const Box& points, Rng& rng) {
  Box part;
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3f share = Vec3(rng.uniform(), rng.uniform(), rng.uniform()).cast<float>();
    part.extend(points.min() + share.cwiseProduct(points.sizes()));
  }
  return part;
}

/// Counts of answers, and of those of which all faces in the way are known.
struct Counts {
  std::array<int, 3> sights{};
  int known = 0;
};

/// Expects that the answers for parts of a box, and for parts of these, are as rays say.
void expect_parts(const Room& room, Sights& sights, std::size_t number, const light::Lit& lamp,
                  std::size_t level, const Box& points, Rng& rng, Counts& counts) {
  for (int k = 0; k < 4; ++k) {
    const Box part = part_of(points, rng);
    const Sight sight = sights.of(number, level, part);
    ++counts.sights[static_cast<std::size_t>(sight)];
    expect_seen(room, lamp, part, sight, rng);
    if (sight != Sight::kSome) continue;
    const Obstacles& obstacles = sights.obstacles(level);
    expect_hidden_by(room, lamp, part, obstacles, rng);
    counts.known += obstacles.unknown.none() ? 1 : 0;
    if (level < kDivisions) {
      expect_parts(room, sights, number, lamp, level + 1, part, rng, counts);
    }
  }
}

TEST(Sights, AreThoseOfEachRay) {
  const Room room;
  Rng rng(1, hash_bytes("sights"), 0);
  std::vector<light::Lit> lamps;
  for (int i = 0; i < 6; ++i) lamps.push_back(lamp(Room::place(rng, 2.2), 800.0));
  Sights sights(room.instances(), lamps);
  Counts whole, parts;
  for (int i = 0; i < 6000; ++i) {
    const Box points = points_on_a_surface(rng);
    const std::size_t number = rng.next() % lamps.size();
    const Sight sight = sights.of(number, 0, points);
    ++whole.sights[static_cast<std::size_t>(sight)];
    expect_seen(room, lamps[number], points, sight, rng);
    if (sight == Sight::kSome) {
      expect_parts(room, sights, number, lamps[number], 1, points, rng, parts);
    }
    ASSERT_FALSE(HasFatalFailure()) << i;
  }
  for (const int count : whole.sights) EXPECT_GT(count, 300);
  for (const int count : parts.sights) EXPECT_GT(count, 300);
  EXPECT_GT(parts.known, 300);
}

TEST(Sights, DoNotDependOnEarlierBoxes) {
  const Room room;
  const std::vector<light::Lit> lamps{lamp({1.5, 1.5, 2.2}, 800.0)};
  Sights used(room.instances(), lamps);
  Rng rng(1, hash_bytes("earlier"), 0);
  for (int i = 0; i < 1000; ++i) {
    const Box points = points_on_a_surface(rng);
    const Sight fresh = Sights(room.instances(), lamps).of(0, 0, points);
    const Sight sight = used.of(0, 0, points);
    // A remembered face may answer where the first one in sight does not, but never otherwise.
    EXPECT_TRUE(sight == fresh || (fresh == Sight::kSome && sight == Sight::kNone)) << i;
  }
}

TEST(Sights, KnowLampsWithoutShadowsAndSuns) {
  const Room room;
  std::vector<light::Lit> lamps{lamp({1.5, 1.5, 2.2}, 800.0), lamp({0.0, 0.0, 20.0}, 800.0)};
  lamps[0].lamp.cast_shadows = false;
  lamps[1].lamp.type = light::Lamp::Type::kDirectional;
  Sights sights(room.instances(), lamps);
  const Box below(Eigen::Vector3f(-1.0F, -1.0F, -3.0F), Eigen::Vector3f(-0.8F, -0.8F, -3.0F));
  EXPECT_EQ(sights.of(0, 0, below), Sight::kAll);
  EXPECT_EQ(sights.of(1, 0, below), Sight::kSome);
  EXPECT_EQ(sights.of(1, 1, below), Sight::kSome);
}

}  // namespace
}  // namespace angen::render
