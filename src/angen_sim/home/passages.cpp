#include <algorithm>
#include <cmath>
#include <optional>

#include "core/named.h"
#include "home/derive.h"
#include "home/solids.h"

namespace angen {

namespace {

constexpr double kNearSide = 0.1;    // m from the middle of an opening, within its wall
constexpr double kFarSide = 0.6;     // m: beyond the thickest wall
constexpr double kSameSide = 0.35;   // m: a leaf is at most that far from the edge of its room
constexpr double kSideStep = 0.05;   // m
constexpr double kOnFloor = 0.1;     // m: the gap under a leaf
constexpr double kBetween = 0.15;    // m between the edges of two leaves of a double door
constexpr double kAtStop = 0.5;      // m between a stop and its storey's floor
constexpr double kFarLanding = 3.0;  // m from the middle of a cabin to a room that it serves
constexpr double kWaits = 0.9;       // m inside of the landing's edge

template <class Part>
const Part* part_named(const std::vector<Part>& all, const std::string& name) {
  const auto index = index_in(all, name);
  return index ? &all[*index] : nullptr;
}

// The greatest box of a joint's child at position 0, in the world.
std::optional<OrientedBox> box_of_child(const HomeSurvey::Standing& standing,
                                        const desc::Joint& joint) {
  const desc::Link* link = part_named(standing.model->links, joint.child);
  std::optional<OrientedBox> greatest;
  const auto take = [&](const Shape& shape, const Pose& pose) {
    const auto box = box_around(shape, standing.pose * link->pose * pose);
    if (box && (!greatest || box->size.prod() > greatest->size.prod())) greatest = box;
  };
  if (link == nullptr) return greatest;
  for (const desc::Collision& collision : link->collisions) take(collision.shape, collision.pose);
  if (greatest) return greatest;
  for (const desc::Visual& visual : link->visuals) take(visual.shape, visual.pose);
  return greatest;
}

const Room* room_in(const Home& home, const Vec3& point) {
  for (const Room& room : home.rooms) {
    if (room.at_height(point.z()) && room.contains(point.head<2>())) return &room;
  }
  return nullptr;
}

// The rooms on the left and on the right of an opening, null for the outside.
std::array<const Room*, 2> sides_of(const Home& home, const HomeDoor& door) {
  const FloorPose& pose = door.pose;
  const Vec3 left(-std::sin(pose.yaw), std::cos(pose.yaw), 0.0);
  const Vec3 middle = pose.position + Vec3::UnitZ() * std::min(1.0, door.height / 2);
  const auto at = [&](double away) { return room_in(home, middle + away * left); };
  std::array<const Room*, 2> sides{};
  for (double away = kNearSide; away <= kFarSide; away += kSideStep) {
    if (sides[0] == nullptr) sides[0] = at(away);
    if (sides[1] == nullptr) sides[1] = at(-away);
  }
  if (sides[0] != sides[1] || sides[0] == nullptr) return sides;
  // It is on the face of a thick wall, whose middle is the edge of the room.
  for (double away = kNearSide; away <= kSameSide; away += kSideStep) {
    for (const std::size_t i : {0, 1}) {
      const double way = i == 0 ? 1.0 : -1.0;
      if (at(way * away) == sides[i]) continue;
      sides[i] = nullptr;
      for (double far = away; far <= kFarSide && sides[i] == nullptr; far += kSideStep) {
        sides[i] = at(way * far);
      }
      return sides;
    }
  }
  return sides;
}

void put_on_floor(const std::array<const Room*, 2>& sides, HomeDoor& door) {
  for (const Room* room : sides) {
    if (room == nullptr) continue;
    const double gap = door.pose.position.z() - room->floor;
    if (std::abs(gap) > kOnFloor) continue;
    door.pose.position.z() = room->floor;
    door.height += gap;
    return;
  }
}

void add(HomeDoor door, Home& home) {
  const std::array<const Room*, 2> sides = sides_of(home, door);
  for (const std::size_t i : {0, 1}) door.rooms[i] = sides[i] == nullptr ? "" : sides[i]->name;
  put_on_floor(sides, door);
  home.doors.push_back(std::move(door));
}

Vec3 along(const HomeDoor& door) { return {std::cos(door.pose.yaw), std::sin(door.pose.yaw), 0.0}; }

struct Leaf {
  HomeDoor door;
  bool slides = false;  // otherwise the x of its pose leads from its hinge to its edge
};

std::optional<Leaf> leaf_of(const HomeSurvey& survey, const HomeSurvey::Leaf& leaf) {
  const HomeSurvey::Standing& standing = survey.models[leaf.model];
  const desc::Joint* joint = part_named(standing.model->joints, leaf.joint);
  if (joint == nullptr) return std::nullopt;
  const std::optional<OrientedBox> box = box_of_child(standing, *joint);
  if (!box) return std::nullopt;
  const Eigen::Matrix3d turn = box->pose.rotation.toRotationMatrix();
  int along = -1;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(turn(2, i)) < 0.7 && (along < 0 || box->size[i] > box->size[along])) along = i;
  }
  const Vec3 hinge = standing.pose * joint->anchor;
  Vec3 way = turn.col(along);
  if (way.dot(box->pose.position - hinge) < 0.0) way = -way;
  const Eigen::AlignedBox3d bounds = box->bounds();
  HomeDoor door;
  door.name = leaf.name;
  door.kind = leaf.kind;
  door.width = box->size[along];
  door.height = bounds.sizes().z();
  door.pose.position = {box->pose.position.x(), box->pose.position.y(), bounds.min().z()};
  door.pose.yaw = std::atan2(way.y(), way.x());
  return Leaf{std::move(door), joint->type == desc::Joint::Type::kPrismatic};
}

// Two leaves of one name are one door.
void add_leaf(Leaf leaf, std::vector<Leaf>& leaves) {
  const HomeDoor& door = leaf.door;
  for (Leaf& each : leaves) {
    HomeDoor& other = each.door;
    if (other.kind != door.kind || other.name != door.name) continue;
    const double away = along(other).dot(door.pose.position - other.pose.position);
    const double low = std::min(-other.width / 2, away - door.width / 2);
    const double high = std::max(other.width / 2, away + door.width / 2);
    other.pose.position += along(other) * (low + high) / 2;
    other.width = high - low;
    return;
  }
  leaves.push_back(std::move(leaf));
}

// m between the edges with which two shut leaves in one line meet; far for others.
double between(const Leaf& one, const Leaf& other) {
  constexpr double kFar = 1e9;
  const Vec3 apart = other.door.pose.position - one.door.pose.position;
  const double same = along(one.door).dot(along(other.door));
  const double ahead = along(one.door).dot(apart);
  if (std::abs(same) < 0.9 || (apart - ahead * along(one.door)).norm() > kBetween) return kFar;
  const bool meet = one.slides || other.slides || (same < 0.0 && ahead > 0.0);
  return meet ? std::abs(std::abs(ahead) - (one.door.width + other.door.width) / 2) : kFar;
}

void pair_leaves(std::vector<Leaf>& leaves) {
  for (Leaf& leaf : leaves) {
    double least = kBetween;
    for (const Leaf& other : leaves) {
      if (&other == &leaf || other.door.kind != leaf.door.kind) continue;
      const double gap = between(leaf, other);
      if (gap >= least) continue;
      least = gap;
      leaf.door.partner = other.door.name;
    }
  }
}

// m from the origin of a cabin to its edge along a way.
double edge_of(const desc::Link& cabin, const Pose& pose, const Vec3& way) {
  double edge = 0.0;
  for (const desc::Collision& collision : cabin.collisions) {
    const auto box = box_around(collision.shape, pose * collision.pose);
    if (!box) continue;
    const Vec3 inside = box->pose.rotation.conjugate() * way;
    edge = std::max(
        edge, (box->pose.position - pose.position).dot(way) + inside.cwiseAbs().dot(box->size) / 2);
  }
  return edge;
}

std::optional<Landing> landing_at(const Home& home, const desc::Link& link, const Pose& cabin,
                                  double z) {
  const Storey* storey = nullptr;
  for (const Storey& each : home.storeys) {
    if (std::abs(each.elevation - z) < kAtStop) storey = &each;
  }
  if (storey == nullptr) return std::nullopt;
  const double yaw = yaw_of(cabin.rotation);
  for (double away = 0.0; away <= kFarLanding; away += kSideStep) {
    for (int side = 0; side < 4; ++side) {
      const double angle = yaw + side * M_PI_2;
      const Vec3 way(std::cos(angle), std::sin(angle), 0.0);
      const Vec3 middle(cabin.position.x(), cabin.position.y(), storey->elevation);
      const Room* room = room_in(home, middle + away * way + Vec3::UnitZ());
      if (room == nullptr) continue;
      Landing landing;
      landing.storey = storey->number;
      landing.room = room->name;
      // also where the room that the elevator is in has no wall around it
      const double edge = std::max(away, edge_of(link, cabin, way));
      landing.pose = {middle + (edge + kWaits) * way, std::remainder(angle + M_PI, 2 * M_PI)};
      return landing;
    }
  }
  return Landing{storey->number, "", {cabin.position, 0.0}};
}

void add(const HomeSurvey& survey, const HomeSurvey::Lift& lift, Home& home) {
  const HomeSurvey::Standing& standing = survey.models[lift.model];
  const desc::Joint* joint = part_named(standing.model->joints, lift.joint);
  const desc::Link* cabin =
      joint == nullptr ? nullptr : part_named(standing.model->links, joint->child);
  if (cabin == nullptr || lift.stops.empty()) return;
  HomeElevator elevator;
  elevator.name = lift.name;
  elevator.pose = standing.pose * cabin->pose;
  elevator.pose.position.z() += lift.stops.front();
  for (const double stop : lift.stops) {
    const double z = elevator.pose.position.z() + stop - lift.stops.front();
    if (const auto landing = landing_at(home, *cabin, elevator.pose, z)) {
      elevator.landings.push_back(*landing);
    }
  }
  home.elevators.push_back(std::move(elevator));
}

void add_openings(const desc::HomeParts& parts, const Pose& frame, Home& home) {
  for (const desc::Opening& opening : parts.openings) {
    HomeDoor door;
    door.name = opening.name;
    door.kind = HomeDoor::Kind::kOpening;
    door.width = opening.width;
    door.height = opening.height;
    door.pose.position = frame * opening.pose.position;
    door.pose.yaw = std::remainder(opening.pose.yaw + yaw_of(frame.rotation), 2 * M_PI);
    const Storey* storey = storey_at(home.storeys, door.pose.position.z());
    door.name = with_storey(door.name, storey == nullptr ? "0" : std::to_string(storey->number));
    add(std::move(door), home);
  }
}

}  // namespace

std::string with_storey(std::string name, const std::string& number) {
  static const std::string mark = "{storey}";
  for (std::size_t at; (at = name.find(mark)) != std::string::npos;) {
    name.replace(at, mark.size(), number);
  }
  return name;
}

void add_passages(const HomeSurvey& survey, Home& home) {
  std::vector<Leaf> leaves;
  for (const HomeSurvey::Leaf& each : survey.leaves) {
    if (auto leaf = leaf_of(survey, each)) add_leaf(*std::move(leaf), leaves);
  }
  pair_leaves(leaves);
  for (Leaf& leaf : leaves) add(std::move(leaf.door), home);
  add_openings(survey.parts, Pose{}, home);
  for (const HomeSurvey::Standing& standing : survey.models) {
    add_openings(standing.model->home, standing.pose, home);
  }
  for (const HomeSurvey::Lift& lift : survey.lifts) add(survey, lift, home);
}

}  // namespace angen
