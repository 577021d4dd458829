#include "light/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace angen::light {
namespace {

constexpr double kCell = 0.4;       // m
constexpr double kPlaneCell = 1.0;  // m: planes are infinite
constexpr double kPart = 0.1;       // m, side of the parts of a divided cell
constexpr int kSitesPerSide = 4;    // sites along a side of a cell
constexpr std::size_t kSites = std::size_t{kSitesPerSide} * kSitesPerSide;
constexpr int kFineSitesPerSide = 2;
constexpr double kSiteLift = 0.02;  // m: leaves stand a gap of some mm above sills
// Of their spacing: the distance of neighbors, which are none diagonally, so that no gap joins
// sides.
constexpr double kNeighbor = 1.38;
constexpr double kLeastArea = 1e-9;  // m^2: that of a shape without extent is not 0
constexpr double kOff = 1e-3;        // m: a closer shape covers a surface
// Of the leaves of doors, in m: the greatest thickness, the least width and height, and a gap at an
// edge that closed ones do not have.
constexpr double kLeaf = 0.1, kLeastLeaf = 0.5, kGap = 0.05;
constexpr rays::Mobilities kAnchored = rays::only(rays::Mobility::kAnchored);
constexpr std::uint32_t kDivided = kNoPatch - 1;

bool rounded(Shape::Type type) {
  return type == Shape::Type::kSphere || type == Shape::Type::kCylinder ||
         type == Shape::Type::kCapsule;
}

double parts_of(double length, double part) {
  return std::max(1.0, std::ceil(length / part - 1e-9));
}

int dominant(const Vec3& v) {
  int axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace

std::size_t Surfaces::HashKey::operator()(const Key& key) const {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const std::int32_t part : key) {
    hash = (hash ^ static_cast<std::uint32_t>(part)) * 0xff51afd7ed558ccdULL;
    hash ^= hash >> 32;
  }
  return hash;
}

Surfaces::Lattice Surfaces::lattice(std::uint32_t shape, int face) const {
  Lattice out;
  out.placement = scene_.placement(shape);
  out.axis = face / 2;
  out.sign = face % 2 == 0 ? 1.0 : -1.0;
  const Eigen::AlignedBox3d& box = out.placement.box;
  for (int side = 0; side < 2; ++side) {
    const int axis = (out.axis + 1 + side) % 3;
    const double size = box.max()[axis] - box.min()[axis];
    const bool endless = !std::isfinite(size);
    out.low[side] = endless ? 0.0 : box.min()[axis];
    out.step[side] = endless ? kPlaneCell : size / parts_of(size, kCell);
    out.parts[side] = parts_of(out.step[side], kPart);
  }
  return out;
}

/// m, sides of a cell or of its part.
Eigen::Array2d Surfaces::step_of(const Key& key) const {
  const Lattice cells = lattice(static_cast<std::uint32_t>(key[0]), key[1]);
  return key[5] != 0 ? Eigen::Array2d(cells.step / cells.parts) : cells.step;
}

double Surfaces::area_of(const Key& key, const std::vector<Site>& sites) const {
  const Lattice cells = lattice(static_cast<std::uint32_t>(key[0]), key[1]);
  const Vec3 axis = cells.placement.pose.rotation * Vec3::Unit(cells.axis);
  const int per_side = key[5] == 1 ? kFineSitesPerSide : kSitesPerSide;
  const double across =
      step_of(key).prod() / (per_side * per_side);  // area of a site, along the axis
  double area = kLeastArea;
  for (const Site& site : sites) area += across / std::abs(site.normal.dot(axis));
  return area;
}

std::uint32_t Surfaces::at(std::uint32_t shape, const Vec3& point, const Vec3& normal) {
  const rays::Placement placement = scene_.placement(shape);
  const Eigen::Matrix3d back = placement.pose.rotation.toRotationMatrix().transpose();
  const Vec3 local = back * (point - placement.pose.position);
  const Vec3 outward = back * normal;
  const int axis = dominant(outward);
  const int face = 2 * axis + (outward[axis] > 0.0 ? 0 : 1);
  const Lattice cells = lattice(shape, face);
  // Number of the surface's layer along the axis.
  int depth = 0;
  if (placement.type == Shape::Type::kBox) depth = local[axis] > 0.0 ? 1 : 0;
  if (rounded(placement.type)) depth = local.dot(outward) > 0.0 ? 1 : 0;
  if (placement.type == Shape::Type::kMesh) {
    depth = static_cast<int>(std::floor((local[axis] - placement.box.min()[axis]) / kCell));
  }
  const Eigen::Array2d in_plane(local[(axis + 1) % 3], local[(axis + 2) % 3]);
  const Eigen::Array2d cell = (in_plane - cells.low) / cells.step;
  const Eigen::Array2d whole = cell.floor().max(-1e6).min(1e6);
  Key key{static_cast<std::int32_t>(shape), face, depth, static_cast<int>(whole.x()),
          static_cast<int>(whole.y()),      0};
  std::uint32_t patch = make(key);
  if (patch != kDivided) return patch;
  const Eigen::Array2d part =
      ((cell - whole) * cells.parts).floor().max(0.0).min(cells.parts - 1.0);
  const Eigen::Array2d all = whole * cells.parts + part;
  key[3] = static_cast<int>(all.x());
  key[4] = static_cast<int>(all.y());
  key[5] = 1;
  patch = make(key);
  return patch == kDivided ? side_at(key, {point, normal}) : patch;
}

std::uint32_t Surfaces::make(const Key& key) {
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  const bool fine = key[5] == 1;
  int covered = 0;
  std::vector<Site> found = sites(key, fine ? kFineSitesPerSide : kSitesPerSide, covered);
  const bool divided = fine ? make_sides(key)
                            : found.empty() || covered > kSitesPerSide ||
                                  is_open_leaf(static_cast<std::uint32_t>(key[0])) ||
                                  is_uneven(key, found) || faced(found);
  return add(key, divided ? std::vector<Site>() : std::move(found), divided);
}

/// A key without sites has no patch.
std::uint32_t Surfaces::add(const Key& key, std::vector<Site> sites, bool divided) {
  keys_[static_cast<std::uint32_t>(key[0])].push_back(key);
  std::uint32_t& number = known_[key];
  number = divided ? kDivided : kNoPatch;
  if (sites.empty()) return number;
  const double area = area_of(key, sites);
  Patch patch{key, HashKey{}(key), std::move(sites), area, ++serials_};
  if (free_.empty()) {
    number = static_cast<std::uint32_t>(patches_.size());
    patches_.push_back(std::move(patch));
  } else {
    number = free_.back();
    free_.pop_back();
    patches_[number] = std::move(patch);
  }
  return number;
}

/// Makes the sides of a part of a cell, if a shape crosses it.
bool Surfaces::make_sides(const Key& key) {
  int covered = 0;
  std::vector<std::vector<Site>> all = sides(key, sites(key, kSitesPerSide, covered)).groups;
  if (all.size() < 2) return false;
  Key side = key;
  for (std::vector<Site>& own : all) {
    ++side[5];
    add(side, std::move(own), false);
  }
  return true;
}

/// The side of the nearest site that sees the point, or of the nearest.
std::uint32_t Surfaces::side_at(const Key& key, const Site& point) const {
  struct Candidate {
    double distance2;
    std::uint32_t patch;
    const Site* site;
  };
  std::vector<Candidate> all;
  Key side = key;
  for (;;) {
    ++side[5];
    const auto found = known_.find(side);
    if (found == known_.end()) break;
    for (const Site& site : patches_[found->second].sites) {
      all.push_back({(site.position - point.position).squaredNorm(), found->second, &site});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance2 < b.distance2;
  });
  const auto seen = std::find_if(all.begin(), all.end(),
                                 [&](const Candidate& to) { return !hidden(point, *to.site); });
  return (seen == all.end() ? all.front() : *seen).patch;
}

/// Also counts the sites that a shape covers.
std::vector<Site> Surfaces::sites(const Key& key, int per_side, int& covered) const {
  const Lattice cells = lattice(static_cast<std::uint32_t>(key[0]), key[1]);
  const Eigen::Array2d step = step_of(key);
  std::array<Site, kSites> found;
  std::size_t count = 0;
  for (int i = 0; i < per_side * per_side; ++i) {
    const double u = key[3] + (i % per_side + 0.5) / per_side;
    const double v = key[4] + (i / per_side + 0.5) / per_side;
    Site& next = found[count];
    if (!site(cells, key, cells.low.x() + u * step.x(), cells.low.y() + v * step.y(), next))
      continue;
    if (scene_.covered(next.position + kOff * next.normal, static_cast<std::uint32_t>(key[0]))) {
      ++covered;
    } else {
      ++count;
    }
  }
  return {found.begin(), found.begin() + count};
}

/// Casts a ray at this shape only, along the face's axis.
bool Surfaces::site(const Lattice& cells, const Key& key, double u, double v, Site& out) const {
  const rays::Placement& placement = cells.placement;
  const int axis = cells.axis;
  const Eigen::AlignedBox3d& box = placement.box;
  const bool far_side = placement.type == Shape::Type::kBox ? key[2] == 1 : cells.sign > 0.0;
  double start = (far_side ? box.max()[axis] : box.min()[axis]) + cells.sign * kOff;
  double reach = box.max()[axis] - box.min()[axis] + 2 * kOff;
  if (rounded(placement.type) && key[2] == 0) start = (box.max()[axis] + box.min()[axis]) / 2;
  if (placement.type == Shape::Type::kMesh) {
    start = box.min()[axis] + kCell * (key[2] + (cells.sign > 0.0 ? 1 : 0));
    reach = kCell;
  }
  Vec3 from;
  from[axis] = start;
  from[(axis + 1) % 3] = u;
  from[(axis + 2) % 3] = v;
  const Vec3 way = -cells.sign * Vec3::Unit(axis);
  rays::Ray ray;
  ray.origin = placement.pose * from;
  ray.direction = placement.pose.rotation * way;
  ray.max = reach;
  const auto shape = static_cast<std::uint32_t>(key[0]);
  const rays::Hit hit = scene_.cast_at(shape, ray);
  if (!hit.hit()) return false;
  out.position = ray.origin + hit.range * ray.direction;
  out.normal = hit.normal.cast<double>().normalized();
  const Vec3 local = placement.pose.rotation.conjugate() * out.normal;
  return dominant(local) == axis;
}

/// Groups of sites; each sees a neighbor in its group along the surface.
Surfaces::Sides Surfaces::sides(const Key& key, const std::vector<Site>& sites) const {
  const double spacing = step_of(key).maxCoeff() / kSitesPerSide;
  const double near2 = std::pow(kNeighbor * spacing, 2);
  Sides out;
  std::vector<std::size_t> group(sites.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if ((sites[i].position - sites[k].position).squaredNorm() > near2) continue;
      if (hidden(sites[i], sites[k])) {
        out.crossed = out.crossed || hidden(sites[i], sites[k], kAnchored);
      } else if (group[i] != group[k]) {
        const std::size_t joined = std::min(group[i], group[k]);
        const std::size_t left = std::max(group[i], group[k]);
        std::replace(group.begin(), group.end(), left, joined);
      }
    }
  }
  std::vector<std::vector<Site>> all(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) all[group[i]].push_back(sites[i]);
  for (std::vector<Site>& own : all) {
    if (!own.empty()) out.groups.push_back(std::move(own));
  }
  return out;
}

bool Surfaces::hidden(const Site& from, const Site& to, rays::Mobilities by) const {
  return scene_.blocked(from.position + kSiteLift * from.normal,
                        to.position + kSiteLift * to.normal, 1e-4, by);
}

/// Whether a shape separates sites, or an anchored one is between some: behind the leaf of a door
/// that is ajar it is dark, and bright beside its edge.
bool Surfaces::is_uneven(const Key& key, const std::vector<Site>& sites) const {
  const Sides found = this->sides(key, sites);
  return found.crossed || found.groups.size() > 1;
}

bool Surfaces::is_open_leaf(std::uint32_t shape) const {
  if (scene_.mobility(shape) != rays::Mobility::kAnchored) return false;
  const rays::Placement at = scene_.placement(shape);
  const Vec3 size = at.box.sizes();
  int thin = 0;
  if (!(size.minCoeff(&thin) < kLeaf)) return false;
  for (int edge = 0; edge < 4; ++edge) {
    const int axis = (thin + 1 + edge / 2) % 3;
    if (size[axis] < kLeastLeaf) return false;
    const Vec3 outward = (edge % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(axis);
    const Vec3 from = at.box.center() + outward * (size[axis] / 2 + kOff);
    if (!scene_.covered(at.pose * from, shape) &&
        !scene_.blocked(at.pose * from, at.pose * (from + kGap * outward), 0.0, kStanding)) {
      return true;
    }
  }
  return false;
}

/// Whether a shape is close in front of any site: light varies strongly along such gaps.
bool Surfaces::faced(const std::vector<Site>& sites) const {
  return std::any_of(sites.begin(), sites.end(), [&](const Site& site) {
    return scene_.blocked(site.position, site.position + kFacing * site.normal, kOff, kStanding);
  });
}

template <class Matches>
void Surfaces::forget_if(std::uint32_t shape, std::vector<std::uint32_t>& removed,
                         Matches&& matches) {
  const auto found = keys_.find(shape);
  if (found == keys_.end()) return;
  std::vector<Key>& keys = found->second;
  const auto forgotten = std::remove_if(keys.begin(), keys.end(), [&](const Key& key) {
    if (!matches(key)) return false;
    const auto entry = known_.find(key);
    if (entry->second < kDivided) {
      patches_[entry->second].alive = false;
      ++forgotten_;
      removed.push_back(entry->second);
    }
    known_.erase(entry);
    return true;
  });
  keys.erase(forgotten, keys.end());
  if (keys.empty()) keys_.erase(found);
}

void Surfaces::forget(std::uint32_t shape, std::vector<std::uint32_t>& removed) {
  forget_if(shape, removed, [](const Key&) { return true; });
}

/// By whole cells: whether a cell is divided depends on all of it.
void Surfaces::forget_near(std::uint32_t shape, const Eigen::AlignedBox3d& box,
                           std::vector<std::uint32_t>& removed) {
  if (keys_.count(shape) == 0) return;
  std::array<Lattice, 6> faces;
  for (int face = 0; face < 6; ++face) faces[static_cast<std::size_t>(face)] = lattice(shape, face);
  const Pose back = faces[0].placement.pose.inverse();
  const bool endless = !box.diagonal().allFinite();
  Eigen::AlignedBox3d local;
  for (int corner = 0; corner < 8 && !endless; ++corner) {
    local.extend(back * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  forget_if(shape, removed, [&](const Key& key) {
    if (endless) return true;
    const Lattice& cells = faces[static_cast<std::size_t>(key[1])];
    for (int side = 0; side < 2; ++side) {
      const int axis = (cells.axis + 1 + side) % 3;
      const int at = key[3 + side];
      const double cell = key[5] == 0 ? at : std::floor(at / cells.parts[side]);
      const double low = cells.low[side] + cell * cells.step[side];
      if (local.min()[axis] > low + cells.step[side] || local.max()[axis] < low) return false;
    }
    const rays::Placement& placement = cells.placement;
    double low = placement.box.min()[cells.axis], high = placement.box.max()[cells.axis];
    if (placement.type == Shape::Type::kBox) low = high = key[2] == 1 ? high : low;
    return local.min()[cells.axis] <= high && local.max()[cells.axis] >= low;
  });
}

void Surfaces::release(const std::vector<std::uint32_t>& removed) {
  free_.insert(free_.end(), removed.begin(), removed.end());
}

}  // namespace angen::light
