#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/lists.h"
#include "home/solids.h"
#include "home/survey.h"

namespace angen {

namespace {

constexpr double kOneStorey = 1.0;   // m: floors that differ by more are on different storeys
constexpr double kWall = 1.0;        // m: lower shapes are furniture
constexpr double kSlab = 0.5;        // m: thicker shapes are no floors
constexpr double kLeastSlab = 1.0;   // m^2
constexpr double kLeastFloor = 4.0;  // m^2 of all slabs at one height
constexpr double kOneLevel = 0.3;    // m between slabs of one floor, as in rooms and on a ground
constexpr double kInFloor = 0.1;     // m that walls may begin over their floor
constexpr double kLowest = 1.9;      // m between two storeys
constexpr double kDoor = 1.7;        // m: lower leaves are windows
constexpr double kFlat = 0.99;       // cosine of the slope of a floor
constexpr double kOneFace = 0.001;   // m between heights of one face
constexpr double kEndless = std::numeric_limits<double>::infinity();

struct Wall {
  double foot;
  double top;
};

struct Slab {
  double top;
  double area;  // m^2; of a plane kEndless
};

// The slabs at one height.
struct Level {
  double lowest = 0.0;   // z of a slab
  double floor = 0.0;    // z of the widest
  double widest = 0.0;   // m^2
  double area = 0.0;     // m^2
  bool carries = false;  // walls stand on it; otherwise they pass it
};

void add_storeys(const desc::HomeParts& parts, const Pose& frame, std::vector<Storey>& storeys) {
  for (const desc::Storey& given : parts.storeys) {
    storeys.push_back({given.number, given.name, frame.position.z() + given.elevation,
                       given.height.value_or(0.0)});
  }
}

std::vector<Storey> numbered(std::vector<double> floors) {
  std::sort(floors.begin(), floors.end());
  std::vector<Storey> storeys;
  double last = 0.0;
  for (const double floor : floors) {
    if (storeys.empty() || floor - last > kOneStorey) {
      storeys.push_back({static_cast<int>(storeys.size()), "", floor, 0.0});
    }
    last = floor;
  }
  return storeys;
}

// The height at which most of a mesh lies flat, on its upper side: a ramp in it may end higher.
double flat_top(const TriangleMesh& mesh, const Pose& frame, double highest) {
  std::map<long, Slab> faces;  // by their heights
  double widest = 0.0;
  for (const auto& corners : mesh.triangles) {
    const auto at = [&](std::size_t i) -> Vec3 {
      return frame * Vec3(mesh.vertices[corners[i]].cast<double>());
    };
    const Vec3 a = at(0);
    const Vec3 twice = (at(1) - a).cross(at(2) - a);
    if (std::abs(twice.z()) < kFlat * twice.norm()) continue;
    Slab& face = faces.try_emplace(std::lround(a.z() / kOneFace), Slab{a.z(), 0.0}).first->second;
    face.area += std::abs(twice.z()) / 2;
    widest = std::max(widest, face.area);
  }
  for (auto face = faces.rbegin(); face != faces.rend(); ++face) {
    if (face->second.area > widest / 2) return face->second.top;
  }
  return highest;
}

void measure(const desc::Model& model, const Pose& pose, std::vector<Wall>& walls,
             std::vector<Slab>& slabs) {
  for (const desc::Link& link : model.links) {
    for (const desc::Collision& collision : link.collisions) {
      const Pose frame = pose * link.pose * collision.pose;
      if (collision.shape.type == Shape::Type::kPlane) {
        slabs.push_back({frame.position.z(), kEndless});
        continue;
      }
      const auto box = box_around(collision.shape, frame);
      if (!box) continue;
      const Eigen::AlignedBox3d bounds = box->bounds();
      const Vec3 size = bounds.sizes();
      const double area = size.x() * size.y();
      if (size.z() >= kWall) {
        walls.push_back({bounds.min().z(), bounds.max().z()});
      } else if (size.z() < kSlab && area > kLeastSlab) {
        const double highest = bounds.max().z();
        const TriangleMesh* mesh = collision.shape.mesh.get();
        slabs.push_back({mesh ? flat_top(*mesh, frame, highest) : highest, area});
      }
    }
  }
}

// The foot of a leaf that hangs or slides on the world, where it is as high as a door.
std::optional<double> foot_of(const desc::Model& model, const Pose& pose,
                              const desc::Joint& joint) {
  if (joint.axes.empty()) return std::nullopt;
  const double upright = std::abs((pose.rotation * joint.axes.front().xyz).z());
  const bool hangs = joint.type == desc::Joint::Type::kRevolute && upright > 0.99;
  const bool slides = joint.type == desc::Joint::Type::kPrismatic && upright < 0.01;
  if (!hangs && !slides) return std::nullopt;
  Eigen::AlignedBox3d leaf;
  for (const desc::Link& link : model.links) {
    if (link.name != joint.child) continue;
    for (const desc::Collision& collision : link.collisions) {
      const auto box = box_around(collision.shape, pose * link.pose * collision.pose);
      if (box) leaf.extend(box->bounds());
    }
  }
  if (leaf.isEmpty()) return (pose * joint.anchor).z();
  if (leaf.sizes().z() < kDoor) return std::nullopt;
  return leaf.min().z();
}

// The places of doors.
void measure_doors(const desc::Model& model, const Pose& pose, std::vector<double>& feet) {
  std::set<std::string> fixed = {"world"};
  for (const desc::Joint& joint : model.joints) {
    if (joint.type == desc::Joint::Type::kFixed && fixed.count(joint.parent) != 0) {
      fixed.insert(joint.child);
    }
  }
  for (const desc::Joint& joint : model.joints) {
    if (fixed.count(joint.parent) == 0) continue;
    if (const auto foot = foot_of(model, pose, joint)) feet.push_back(*foot);
  }
}

std::vector<Level> levels_of(std::vector<Slab> slabs) {
  std::sort(slabs.begin(), slabs.end(), [](const Slab& a, const Slab& b) { return a.top < b.top; });
  std::vector<Level> levels;
  for (const Slab& slab : slabs) {
    if (levels.empty() || slab.top - levels.back().lowest > kOneLevel) {
      levels.emplace_back();
      levels.back().lowest = slab.top;
    }
    Level& level = levels.back();
    level.area += slab.area;
    // a slab on the ground is the floor, and not the ground
    const double area = slab.area < kEndless ? slab.area : kLeastFloor;
    if (area <= level.widest) continue;
    level.widest = area;
    level.floor = slab.top;
  }
  return levels;
}

// Whether it may be a floor.
bool meets_walls(Level& level, const std::vector<Wall>& walls) {
  if (level.area < kLeastFloor) return false;
  bool passed = false;
  for (const Wall& wall : walls) {
    if (wall.foot > level.floor + kInFloor) continue;
    level.carries = level.carries || wall.foot > level.floor - kOneLevel;
    passed = passed || wall.top > level.floor + kLowest;
  }
  return level.carries || passed;
}

void add_apart(double floor, std::vector<double>& floors) {
  for (const double other : floors) {
    if (std::abs(floor - other) <= kLowest) return;
  }
  floors.push_back(floor);
}

// The floors of walls that no one describes: the widest first, those on which walls stand
// before those that walls pass; a surface too near to such a one is furniture or a ceiling.
std::vector<double> floors_of(const std::vector<Wall>& walls, const std::vector<Slab>& slabs) {
  std::vector<Level> levels = levels_of(slabs);
  erase_if(levels, [&](Level& level) { return !meets_walls(level, walls); });
  std::stable_sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
    return a.carries != b.carries ? a.carries : a.area > b.area;
  });
  std::vector<double> floors;
  for (const Level& level : levels) add_apart(level.floor, floors);
  if (floors.empty() && !walls.empty()) {
    const auto lowest = std::min_element(
        walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.foot < b.foot; });
    floors.push_back(lowest->foot);
  }
  return floors;
}

}  // namespace

std::vector<Storey> storeys_of(const desc::HomeParts& world,
                               const std::vector<std::pair<const desc::Model*, Pose>>& models) {
  std::vector<Storey> storeys;
  std::vector<double> floors;
  const auto take = [&](const desc::HomeParts& parts, const Pose& frame) {
    add_storeys(parts, frame, storeys);
    for (const Room& room : rooms_of(parts, frame, "")) floors.push_back(room.floor);
  };
  take(world, Pose{});
  for (const auto& [model, pose] : models) take(model->home, pose);
  if (!storeys.empty()) {
    std::stable_sort(storeys.begin(), storeys.end(),
                     [](const Storey& a, const Storey& b) { return a.elevation < b.elevation; });
    return storeys;
  }
  if (!floors.empty()) return numbered(std::move(floors));
  std::vector<Wall> walls;
  std::vector<Slab> slabs;
  std::vector<double> feet;
  for (const auto& [model, pose] : models) {
    if (!model->is_static) {
      measure_doors(*model, pose, feet);
    } else if (model->home.thing.empty()) {
      measure(*model, pose, walls, slabs);
    }
  }
  floors = floors_of(walls, slabs);
  for (const Slab& slab : slabs) {
    if (floors.empty() && !feet.empty() && slab.area == kEndless) floors.push_back(slab.top);
  }
  std::sort(feet.begin(), feet.end());
  for (const double foot : feet) add_apart(foot, floors);
  return numbered(std::move(floors));
}

}  // namespace angen
