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
constexpr int kSitesPerSide = 4;    // of a cell
constexpr std::size_t kSites = std::size_t{kSitesPerSide} * kSitesPerSide;
constexpr int kFineSitesPerSide = 2;
constexpr double kSiteLift = 0.01;  // m off the surface, for visibility between its sites
constexpr double kOff = 1e-3;       // m: a closer shape covers a surface
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
  return make(key);
}

std::uint32_t Surfaces::make(const Key& key) {
  const auto [found, fresh] = known_.try_emplace(key, kNoPatch);
  if (!fresh) return found->second;
  keys_[static_cast<std::uint32_t>(key[0])].push_back(key);
  const bool fine = key[5] == 1;
  int covered = 0;
  Patch patch{key, HashKey{}(key), sites(key, fine ? kFineSitesPerSide : kSitesPerSide, covered),
              serials_ + 1};
  if (!fine && (patch.sites.empty() || covered > kSitesPerSide || parted(patch.sites) ||
                faced(patch.sites))) {
    return found->second = kDivided;
  }
  if (patch.sites.empty()) return kNoPatch;
  ++serials_;
  if (free_.empty()) {
    found->second = static_cast<std::uint32_t>(patches_.size());
    patches_.push_back(std::move(patch));
  } else {
    found->second = free_.back();
    free_.pop_back();
    patches_[found->second] = std::move(patch);
  }
  return found->second;
}

/// Also counts the sites that a shape covers.
std::vector<Site> Surfaces::sites(const Key& key, int per_side, int& covered) const {
  const Lattice cells = lattice(static_cast<std::uint32_t>(key[0]), key[1]);
  const Eigen::Array2d step = key[5] == 1 ? Eigen::Array2d(cells.step / cells.parts) : cells.step;
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

/// Whether the sites form groups that do not see each other along the surface.
bool Surfaces::parted(const std::vector<Site>& sites) const {
  std::vector<std::size_t> reached{0};
  std::vector<bool> seen(sites.size(), false);
  seen[0] = true;
  double spacing2 = 0.0;
  for (const Site& site : sites) {
    spacing2 = std::max(spacing2, (site.position - sites[0].position).squaredNorm());
  }
  // Neighbors are a third of the cell's side apart; twice that bridges a covered one.
  const double near2 = 0.3 * spacing2;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const Site& from = sites[reached[next]];
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (seen[i] || (sites[i].position - from.position).squaredNorm() > near2) continue;
      if (scene_.blocked(from.position + kSiteLift * from.normal,
                         sites[i].position + kSiteLift * sites[i].normal, 1e-4, kStanding)) {
        continue;
      }
      seen[i] = true;
      reached.push_back(i);
    }
  }
  return reached.size() != sites.size();
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
