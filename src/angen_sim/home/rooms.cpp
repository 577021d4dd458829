#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "home/derive.h"
#include "home/grid.h"
#include "home/solids.h"

namespace angen {

namespace {

constexpr double kSquare = 0.05;        // m
constexpr double kMaxSquares = 4e6;     // most squares of a plan
constexpr double kWallHeight = 1.0;     // m: lower shapes are furniture
constexpr double kSmallestRoom = 1.0;   // m^2
constexpr double kPassage = 0.55;       // m, half the width of the widest gap between two rooms
constexpr double kUsualCeiling = 2.5;   // m
constexpr double kTolerance = 0.08;     // m, of corners
constexpr double kNarrow = 0.3;         // m, half the width of the narrowest room
constexpr double kPillar = 0.25;        // m^2: smaller ones are left out
constexpr double kLowestCeiling = 1.9;  // m
constexpr double kAsMuch =
    0.8;  // share of the area found at a lower height that is enough at a higher
constexpr double kHeights[] = {2.3, 2.0, 1.5,
                               1.0};  // m over the floor: above lintels, if there are

// A static model that is no thing: walls, floors and ceilings.
bool is_of_building(const HomeSurvey::Standing& standing) {
  return standing.model->is_static && standing.model->home.thing.empty();
}

struct Solid {
  const desc::Collision* collision;
  Pose frame;
  OrientedBox box;
  Eigen::AlignedBox3d bounds;
};

std::vector<Solid> solids_of(const HomeSurvey& survey) {
  std::set<std::size_t> leaves;
  for (const HomeSurvey::Leaf& leaf : survey.leaves) leaves.insert(leaf.model);
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < survey.models.size(); ++i) {
    const HomeSurvey::Standing& standing = survey.models[i];
    if (!is_of_building(standing) && leaves.count(i) == 0) continue;
    for (const desc::Link& link : standing.model->links) {
      for (const desc::Collision& collision : link.collisions) {
        const Pose frame = standing.pose * link.pose * collision.pose;
        const auto box = box_around(collision.shape, frame);
        if (box) solids.push_back({&collision, frame, *box, box->bounds()});
      }
    }
  }
  return solids;
}

// The walls of one storey at one height.
class Plan {
 public:
  Plan(const std::vector<Solid>& solids, double height) : height_(height) {
    Eigen::AlignedBox2d around;
    for (const Solid& solid : solids) {
      if (!is_cut(solid)) continue;
      around.extend(Point2(solid.bounds.min().head<2>()));
      around.extend(Point2(solid.bounds.max().head<2>()));
    }
    if (around.isEmpty()) return;
    const Point2 size = around.sizes();
    grid_.side = std::max(kSquare, std::sqrt(size.x() * size.y() / kMaxSquares));
    if (size.maxCoeff() / grid_.side > kMaxSquares / 100) return;  // a wall of kilometers
    const int margin = 2 + static_cast<int>(3 * kPassage / grid_.side);
    grid_.origin = around.min() - Point2::Constant(margin * grid_.side);
    grid_.columns = static_cast<int>(std::ceil(size.x() / grid_.side)) + 2 * margin;
    grid_.rows = static_cast<int>(std::ceil(size.y() / grid_.side)) + 2 * margin;
    grid_.cells.assign(grid_.index(0, grid_.rows), Grid::kFree);
    for (const Solid& solid : solids) {
      if (is_cut(solid)) draw(solid);
    }
  }

  std::vector<Room> rooms() {
    if (grid_.cells.empty()) return {};
    away_ = wall_distances(grid_, 2 * kPassage);
    split_at_gaps();
    std::vector<Room> found;
    const std::vector<bool> is_room = rooms_by_label();
    for (std::size_t label = 0; label < is_room.size(); ++label) {
      if (!is_room[label]) continue;
      if (auto room = room_of(static_cast<std::int32_t>(label))) found.push_back(*std::move(room));
    }
    return found;
  }

 private:
  bool is_cut(const Solid& solid) const {
    return solid.bounds.min().z() <= height_ && solid.bounds.max().z() >= height_;
  }

  template <class IsIn>
  void mark(const Point2& low, const Point2& high, const IsIn& is_in) {
    const auto square = [&](double from, double to, int count) {
      return std::clamp(static_cast<int>((to - from) / grid_.side), 0, count - 1);
    };
    const int last_row = square(grid_.origin.y(), high.y(), grid_.rows);
    const int last_column = square(grid_.origin.x(), high.x(), grid_.columns);
    for (int row = square(grid_.origin.y(), low.y(), grid_.rows); row <= last_row; ++row) {
      for (int column = square(grid_.origin.x(), low.x(), grid_.columns); column <= last_column;
           ++column) {
        if (is_in(grid_.middle(column, row))) grid_.at(column, row) = Grid::kWall;
      }
    }
  }

  void draw(const Solid& solid) {
    const Shape& shape = solid.collision->shape;
    if (shape.type == Shape::Type::kMesh) return draw_mesh(solid);
    const bool round = shape.type != Shape::Type::kBox;
    const Pose back = solid.box.pose.inverse();
    const double thin = 0.71 * grid_.side;  // so that squares of a thin wall are connected
    const Vec3 half = (solid.box.size / 2).cwiseMax(Vec3::Constant(thin));
    mark(solid.bounds.min().head<2>(), solid.bounds.max().head<2>(), [&](const Point2& point) {
      const Vec3 local = back * Vec3(point.x(), point.y(), height_);
      if (round) return local.head<2>().norm() <= half.x();
      return (local.cwiseAbs().array() <= half.array()).all();
    });
  }

  void draw_mesh(const Solid& solid) {
    const TriangleMesh& mesh = *solid.collision->shape.mesh;
    for (const auto& triangle : mesh.triangles) {
      std::vector<Point2> cut;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto corner = [&](std::size_t k) {
          return solid.frame * Vec3(mesh.vertices[triangle[k % 3]].cast<double>());
        };
        const Vec3 a = corner(i);
        const Vec3 b = corner(i + 1);
        if ((a.z() > height_) == (b.z() > height_)) continue;
        cut.emplace_back((a + (height_ - a.z()) / (b.z() - a.z()) * (b - a)).head<2>());
      }
      if (cut.size() != 2) continue;
      const double length = (cut[1] - cut[0]).norm();
      const int steps = 1 + static_cast<int>(2.0 * length / grid_.side);
      for (int i = 0; i <= steps; ++i) {
        const Point2 point = cut[0] + (cut[1] - cut[0]) * i / steps;
        mark(point, point, [](const Point2&) { return true; });
      }
    }
  }

  // Doorways as high as their walls connect rooms with each other and with the outside: parts
  // remain when narrow gaps are closed.
  void split_at_gaps() {
    Grid wide = grid_;
    for (std::size_t i = 0; i < wide.cells.size(); ++i) {
      if (away_[i] < kPassage) wide.cells[i] = Grid::kWall;
    }
    const std::vector<std::size_t> sizes = number_parts(wide);
    const double least = kSmallestRoom / 4 / (grid_.side * grid_.side);
    for (std::size_t i = 0; i < wide.cells.size(); ++i) {
      const std::int32_t label = wide.cells[i];
      if (label >= 0 && static_cast<double>(sizes[static_cast<std::size_t>(label)]) >= least) {
        grid_.cells[i] = label;
      }
    }
    grow_labels(grid_);
    // Rooms that are narrow all over.
    Grid rest = grid_;
    for (std::int32_t& label : rest.cells) {
      if (label >= 0) label = Grid::kWall;
    }
    number_parts(rest);
    for (std::size_t i = 0; i < rest.cells.size(); ++i) {
      if (rest.cells[i] < 0) continue;
      grid_.cells[i] = static_cast<std::int32_t>(sizes.size()) + rest.cells[i];
    }
  }

  // The outside and the insides of walls are no rooms.
  std::vector<bool> rooms_by_label() const {
    std::vector<bool> is_room;
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      if (grid_.cells[i] < 0) continue;
      const auto label = static_cast<std::size_t>(grid_.cells[i]);
      if (label >= is_room.size()) is_room.resize(label + 1, false);
      if (away_[i] >= kNarrow) is_room[label] = true;
    }
    const std::int32_t outside = grid_.at(0, 0);
    if (outside >= 0) is_room[static_cast<std::size_t>(outside)] = false;
    return is_room;
  }

  std::optional<Room> room_of(std::int32_t label) const {
    std::optional<Region> region = region_of(grid_, label, kTolerance, kPillar);
    if (!region || signed_area(region->outline) < kSmallestRoom) return std::nullopt;
    Room room;
    room.outline = std::move(region->outline);
    room.holes = std::move(region->holes);
    return room;
  }

  double height_;
  Grid grid_;
  std::vector<double> away_;  // m from each square to a wall
};

// The underside of the shapes over a room's corners.
double ceiling_over(const Room& room, const std::vector<Solid>& solids, double floor) {
  double ceiling = floor + kUsualCeiling;
  double lowest = floor + 6.0;
  for (const Solid& solid : solids) {
    const double under = solid.bounds.min().z();
    const Vec3 size = solid.bounds.sizes();
    if (under < floor + kLowestCeiling || under >= lowest) continue;
    if (size.x() * size.y() < kSmallestRoom || size.z() > kWallHeight) continue;
    const Point2 middle = solid.bounds.center().head<2>();
    if (!room.contains(middle)) continue;
    lowest = ceiling = under;
  }
  return ceiling;
}

double covered(const std::vector<Room>& rooms) {
  double area = 0.0;
  for (const Room& room : rooms) area += std::abs(signed_area(room.outline));
  return area;
}

}  // namespace

std::vector<Room> guess_rooms(const HomeSurvey& survey) {
  const std::vector<Solid> solids = solids_of(survey);
  std::vector<Room> rooms;
  for (const Storey& storey : survey.storeys) {
    const double floor = storey.elevation;
    std::vector<Room> best;
    for (const double height : kHeights) {
      std::vector<Room> found = Plan(solids, floor + height).rooms();
      if (kAsMuch * covered(found) > covered(best)) best = std::move(found);
    }
    for (Room& room : best) {
      room.use = "other";
      room.floor = floor;
      room.ceiling = ceiling_over(room, solids, floor);
      rooms.push_back(std::move(room));
    }
  }
  return rooms;
}

}  // namespace angen
