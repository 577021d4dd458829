#include "light/surfaces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

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

constexpr double kMostCells = 1 << 14;
// Numbers of cells and parts that are none of a patch.
constexpr std::uint32_t kUnknown = kNoPatch - 1;
constexpr std::uint32_t kBlock = 1U << 31;

bool is_block(std::uint32_t number) { return number >= kBlock && number < kUnknown; }

std::uint64_t new_serial() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::uint64_t hash_of(const std::array<std::int32_t, 6>& key) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const std::int32_t part : key) {
    hash = (hash ^ static_cast<std::uint32_t>(part)) * 0xff51afd7ed558ccdULL;
    hash ^= hash >> 32;
  }
  return hash;
}

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

using Box = Eigen::AlignedBox3d;

/// The box around one in another frame; an endless one stays endless.
Box box_around(const Pose& pose, const Box& box) {
  const double endless = std::numeric_limits<double>::infinity();
  if (!box.diagonal().allFinite()) return {Vec3::Constant(-endless), Vec3::Constant(endless)};
  Box around;
  for (int corner = 0; corner < 8; ++corner) {
    around.extend(pose * box.corner(static_cast<Box::CornerType>(corner)));
  }
  return around;
}

/// Whether the site does not see the other one; the scene or what is near of it.
template <class Shapes>
bool hidden(const Shapes& shapes, const Site& from, const Site& to, rays::Mobilities by) {
  return shapes.blocked(from.position + kSiteLift * from.normal,
                        to.position + kSiteLift * to.normal, 1e-4, by);
}

}  // namespace

Surfaces::Own* Surfaces::own_of(std::uint32_t shape) {
  if (shapes_.size() <= shape) shapes_.resize(shape + 1);
  Own& own = shapes_[shape];
  if (!own.form) {
    if (!scene_->standing(shape)) return nullptr;
    own.form = form_of(shape);
    own.cells.assign(own.form->cells, kUnknown);
  }
  return &own;
}

std::shared_ptr<const Surfaces::Form> Surfaces::form_of(std::uint32_t shape) const {
  auto form = std::make_shared<Form>();
  form->placement = scene_->placement(shape);
  form->back = form->placement.pose.rotation.toRotationMatrix().transpose();
  const Eigen::AlignedBox3d& box = form->placement.box;
  for (int face = 0; face < 6; ++face) {
    Lattice& out = form->faces[static_cast<std::size_t>(face)];
    out.axis = face / 2;
    out.sign = face % 2 == 0 ? 1.0 : -1.0;
    Eigen::Array3d count;
    for (int side = 0; side < 2; ++side) {
      const int axis = (out.axis + 1 + side) % 3;
      const double size = box.max()[axis] - box.min()[axis];
      const bool endless = !std::isfinite(size);
      out.low[side] = endless ? 0.0 : box.min()[axis];
      out.step[side] = endless ? kPlaneCell : size / parts_of(size, kCell);
      out.parts[side] = parts_of(out.step[side], kPart);
      count[side] = endless ? kMostCells : parts_of(size, kCell) + 2.0;
    }
    const double depth = box.max()[out.axis] - box.min()[out.axis];
    count[2] = form->placement.type == Shape::Type::kMesh ? std::floor(depth / kCell) + 3.0 : 2.0;
    if (!(count.prod() < kMostCells)) continue;
    out.first = form->cells;
    out.columns = static_cast<std::int32_t>(count[0]);
    out.rows = static_cast<std::int32_t>(count[1]);
    out.layers = static_cast<std::int32_t>(count[2]);
    form->cells += static_cast<std::size_t>(count.prod());
  }
  return form;
}

const Surfaces::Lattice& Surfaces::lattice(const Key& key) const {
  return shapes_[static_cast<std::size_t>(key[0])].form->faces[static_cast<std::size_t>(key[1])];
}

/// The place in `own.cells` of a whole cell.
std::size_t Surfaces::cell_of(Own& own, const Key& key) {
  const Lattice& face = own.form->faces[static_cast<std::size_t>(key[1])];
  const bool is_mesh = own.form->placement.type == Shape::Type::kMesh;
  const std::int32_t layer = key[2] + (is_mesh ? 1 : 0), u = key[3] + 1, v = key[4] + 1;
  if (layer >= 0 && layer < face.layers && u >= 0 && u < face.columns && v >= 0 && v < face.rows) {
    return face.first + static_cast<std::size_t>((layer * face.rows + v) * face.columns + u);
  }
  std::uint64_t packed = static_cast<std::uint64_t>(key[1]);
  for (const int part : {2, 3, 4}) {
    packed = (packed << 20) ^
             (static_cast<std::uint32_t>(key[static_cast<std::size_t>(part)]) & 0xfffffU);
  }
  const auto [found, is_new] =
      own.far.try_emplace(packed, static_cast<std::uint32_t>(own.cells.size()));
  if (is_new) {
    own.cells.push_back(kUnknown);
    own.far_keys.push_back(key);
  }
  return found->second;
}

std::uint32_t Surfaces::add_block(Own& own, std::vector<std::uint32_t> numbers) {
  if (own.free_blocks.empty()) {
    own.free_blocks.push_back(static_cast<std::uint32_t>(own.blocks.size()));
    own.blocks.emplace_back();
  }
  const std::uint32_t block = own.free_blocks.back();
  own.free_blocks.pop_back();
  own.blocks[block] = std::move(numbers);
  return kBlock + block;
}

/// m, sides of a cell or of its part.
Eigen::Array2d Surfaces::step_of(const Key& key) const {
  const Lattice& cells = lattice(key);
  return key[5] != 0 ? Eigen::Array2d(cells.step / cells.parts) : cells.step;
}

double Surfaces::area_of(const Key& key, const std::vector<Site>& sites) const {
  const rays::Placement& placement = shapes_[static_cast<std::size_t>(key[0])].form->placement;
  const Vec3 axis = placement.pose.rotation * Vec3::Unit(lattice(key).axis);
  const int per_side = key[5] == 1 ? kFineSitesPerSide : kSitesPerSide;
  const double across =
      step_of(key).prod() / (per_side * per_side);  // area of a site, along the axis
  double area = kLeastArea;
  for (const Site& site : sites) area += across / std::abs(site.normal.dot(axis));
  return area;
}

std::uint32_t Surfaces::at(std::uint32_t shape, const Vec3& point, const Vec3& normal) {
  Own* own = own_of(shape);
  if (own == nullptr) return kNoPatch;
  const rays::Placement& placement = own->form->placement;
  const Vec3 local = own->form->back * (point - placement.pose.position);
  const Vec3 outward = own->form->back * normal;
  const int axis = dominant(outward);
  const int face = 2 * axis + (outward[axis] > 0.0 ? 0 : 1);
  const Lattice& cells = own->form->faces[static_cast<std::size_t>(face)];
  // Number of the surface's layer along the axis.
  int depth = 0;
  if (placement.type == Shape::Type::kBox) depth = local[axis] > 0.0 ? 1 : 0;
  if (rounded(placement.type)) depth = local.dot(outward) > 0.0 ? 1 : 0;
  if (placement.type == Shape::Type::kMesh) {
    depth = static_cast<int>(std::floor((local[axis] - placement.box.min()[axis]) / kCell));
  }
  const Eigen::Array2d in_plane(local[(axis + 1) % 3], local[(axis + 2) % 3]);
  const Eigen::Array2d cell = (in_plane - cells.low) / cells.step;
  const Eigen::Array2d whole = cell.floor().max(-5e5).min(5e5);
  Key key{static_cast<std::int32_t>(shape), face, depth, static_cast<int>(whole.x()),
          static_cast<int>(whole.y()),      0};
  const std::size_t place = cell_of(*own, key);
  if (own->cells[place] == kUnknown) own->cells[place] = make_cell(*own, key);
  const std::uint32_t number = own->cells[place];
  if (!is_block(number)) return number;
  const Eigen::Array2d part =
      ((cell - whole) * cells.parts).floor().max(0.0).min(cells.parts - 1.0);
  const Eigen::Array2d all = whole * cells.parts + part;
  key[3] = static_cast<int>(all.x());
  key[4] = static_cast<int>(all.y());
  key[5] = 1;
  const auto in_block = static_cast<std::size_t>(part.y() * cells.parts.x() + part.x());
  const std::uint32_t known = own->blocks[number - kBlock][in_block];
  const std::uint32_t found = known == kUnknown ? make_part(*own, key) : known;
  own->blocks[number - kBlock][in_block] = found;
  return is_block(found) ? side_at(own->blocks[found - kBlock], {point, normal}) : found;
}

/// The shapes that can cover or separate the sites of a cell or part.
rays::Nearby Surfaces::around(const Key& key) const {
  const Form& form = *shapes_[static_cast<std::size_t>(key[0])].form;
  const Lattice& cells = lattice(key);
  const Eigen::Array2d step = step_of(key);
  Eigen::AlignedBox3d own = form.placement.box;
  for (int side = 0; side < 2; ++side) {
    const int axis = (cells.axis + 1 + side) % 3;
    own.min()[axis] = cells.low[side] + key[3 + side] * step[side];
    own.max()[axis] = own.min()[axis] + step[side];
  }
  if (form.placement.type == Shape::Type::kBox) {
    (key[2] == 1 ? own.min() : own.max())[cells.axis] =
        (key[2] == 1 ? own.max() : own.min())[cells.axis];
  }
  if (form.placement.type == Shape::Type::kMesh) {
    own.min()[cells.axis] += kCell * key[2];
    own.max()[cells.axis] = own.min()[cells.axis] + kCell;
  }
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    box.extend(form.placement.pose *
               own.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  const Vec3 out = Vec3::Constant(kSiteLift + 2 * kOff);
  return scene_->near({box.min() - out, box.max() + out});
}

/// A patch, a block of parts, or kNoPatch.
std::uint32_t Surfaces::make_cell(Own& own, const Key& key) {
  const rays::Nearby near = around(key);
  int covered = 0;
  std::vector<Site> found = sites(key, kSitesPerSide, near, covered);
  const bool divided = found.empty() || covered > kSitesPerSide ||
                       is_open_leaf(static_cast<std::uint32_t>(key[0])) ||
                       is_uneven(key, found, near) || faced(found);
  if (!divided) return add(key, std::move(found));
  const auto parts = static_cast<std::size_t>(lattice(key).parts.prod());
  return add_block(own, std::vector<std::uint32_t>(parts, kUnknown));
}

/// A patch, a block of sides if a shape crosses the part, or kNoPatch.
std::uint32_t Surfaces::make_part(Own& own, const Key& key) {
  const rays::Nearby near = around(key);
  int covered = 0;
  std::vector<std::vector<Site>> all =
      sides(key, sites(key, kSitesPerSide, near, covered), near).groups;
  if (all.size() < 2) return add(key, sites(key, kFineSitesPerSide, near, covered));
  Key side = key;
  std::vector<std::uint32_t> numbers;
  for (std::vector<Site>& group : all) {
    ++side[5];
    numbers.push_back(add(side, std::move(group)));
  }
  return add_block(own, std::move(numbers));
}

/// The patch with these sites; without any there is none.
std::uint32_t Surfaces::add(const Key& key, std::vector<Site> sites) {
  if (sites.empty()) return kNoPatch;
  const double area = area_of(key, sites);
  auto patch =
      std::make_shared<const Patch>(Patch{key, hash_of(key), std::move(sites), area, new_serial()});
  if (free_.empty()) {
    patches_.push_back(std::move(patch));
    return static_cast<std::uint32_t>(patches_.size() - 1);
  }
  const std::uint32_t number = free_.back();
  free_.pop_back();
  patches_[number] = std::move(patch);
  return number;
}

/// The side of the nearest site that sees the point, or of the nearest.
std::uint32_t Surfaces::side_at(const std::vector<std::uint32_t>& sides, const Site& point) const {
  struct Candidate {
    double distance2;
    std::uint32_t patch;
    const Site* site;
  };
  std::vector<Candidate> all;
  for (const std::uint32_t side : sides) {
    for (const Site& site : patches_[side]->sites) {
      all.push_back({(site.position - point.position).squaredNorm(), side, &site});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance2 < b.distance2;
  });
  const auto seen = std::find_if(all.begin(), all.end(), [&](const Candidate& to) {
    return !hidden(*scene_, point, *to.site, kStanding);
  });
  return (seen == all.end() ? all.front() : *seen).patch;
}

/// Also counts the sites that a shape covers.
std::vector<Site> Surfaces::sites(const Key& key, int per_side, const rays::Nearby& near,
                                  int& covered) const {
  const Lattice& cells = lattice(key);
  const Eigen::Array2d step = step_of(key);
  std::array<Site, kSites> found;
  std::size_t count = 0;
  for (int i = 0; i < per_side * per_side; ++i) {
    const double u = key[3] + (i % per_side + 0.5) / per_side;
    const double v = key[4] + (i / per_side + 0.5) / per_side;
    Site& next = found[count];
    if (!site(cells, key, cells.low.x() + u * step.x(), cells.low.y() + v * step.y(), next))
      continue;
    if (near.covered(next.position + kOff * next.normal, static_cast<std::uint32_t>(key[0]))) {
      ++covered;
    } else {
      ++count;
    }
  }
  return {found.begin(), found.begin() + count};
}

/// Casts a ray at this shape only, along the face's axis.
bool Surfaces::site(const Lattice& cells, const Key& key, double u, double v, Site& out) const {
  const rays::Placement& placement = shapes_[static_cast<std::size_t>(key[0])].form->placement;
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
  const rays::Hit hit = scene_->cast_at(shape, ray);
  if (!hit.hit()) return false;
  out.position = ray.origin + hit.range * ray.direction;
  out.normal = hit.normal.cast<double>().normalized();
  const Vec3 local = placement.pose.rotation.conjugate() * out.normal;
  return dominant(local) == axis;
}

/// Groups of sites; each sees a neighbor in its group along the surface.
Surfaces::Sides Surfaces::sides(const Key& key, const std::vector<Site>& sites,
                                const rays::Nearby& near) const {
  const double spacing = step_of(key).maxCoeff() / kSitesPerSide;
  const double near2 = std::pow(kNeighbor * spacing, 2);
  Sides out;
  std::vector<std::size_t> group(sites.size());
  std::iota(group.begin(), group.end(), 0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if ((sites[i].position - sites[k].position).squaredNorm() > near2) continue;
      if (hidden(near, sites[i], sites[k], kStanding)) {
        out.crossed = out.crossed || hidden(near, sites[i], sites[k], kAnchored);
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

/// Whether a shape separates sites, or an anchored one is between some: behind the leaf of a
/// door that is ajar it is dark, and bright beside its edge.
bool Surfaces::is_uneven(const Key& key, const std::vector<Site>& sites,
                         const rays::Nearby& near) const {
  const Sides found = this->sides(key, sites, near);
  return found.crossed || found.groups.size() > 1;
}

bool Surfaces::is_open_leaf(std::uint32_t shape) const {
  if (scene_->mobility(shape) != rays::Mobility::kAnchored) return false;
  const rays::Placement at = scene_->placement(shape);
  const Vec3 size = at.box.sizes();
  int thin = 0;
  if (!(size.minCoeff(&thin) < kLeaf)) return false;
  for (int edge = 0; edge < 4; ++edge) {
    const int axis = (thin + 1 + edge / 2) % 3;
    if (size[axis] < kLeastLeaf) return false;
    const Vec3 outward = (edge % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(axis);
    const Vec3 from = at.box.center() + outward * (size[axis] / 2 + kOff);
    if (!scene_->covered(at.pose * from, shape) &&
        !scene_->blocked(at.pose * from, at.pose * (from + kGap * outward), 0.0, kStanding)) {
      return true;
    }
  }
  return false;
}

/// Whether a shape is close in front of any site: light varies strongly along such gaps.
bool Surfaces::faced(const std::vector<Site>& sites) const {
  return std::any_of(sites.begin(), sites.end(), [&](const Site& site) {
    return scene_->blocked(site.position, site.position + kFacing * site.normal, kOff, kStanding);
  });
}

void Surfaces::forget_number(Own& own, std::uint32_t& number, std::vector<std::uint32_t>& removed) {
  const std::uint32_t known = std::exchange(number, kUnknown);
  if (known < kBlock) {
    patches_[known] = nullptr;
    ++forgotten_;
    removed.push_back(known);
  } else if (is_block(known)) {
    for (std::uint32_t& part : std::exchange(own.blocks[known - kBlock], {})) {
      forget_number(own, part, removed);
    }
    own.free_blocks.push_back(known - kBlock);
  }
}

void Surfaces::forget(std::uint32_t shape, std::vector<std::uint32_t>& removed) {
  if (shapes_.size() <= shape || !shapes_[shape].form) return;
  for (std::uint32_t& number : shapes_[shape].cells) {
    forget_number(shapes_[shape], number, removed);
  }
  shapes_[shape] = {};
}

/// The box of a cell in its shape's frame; along the axis of its face, all of a mesh.
Eigen::AlignedBox3d Surfaces::cell_box(const Form& form, const Lattice& cells, int layer, int u,
                                       int v) {
  Eigen::AlignedBox3d box = form.placement.box;
  for (int side = 0; side < 2; ++side) {
    const int axis = (cells.axis + 1 + side) % 3;
    box.min()[axis] = cells.low[side] + (side == 0 ? u : v) * cells.step[side];
    box.max()[axis] = box.min()[axis] + cells.step[side];
  }
  if (form.placement.type == Shape::Type::kBox) {
    (layer == 1 ? box.min() : box.max())[cells.axis] =
        (layer == 1 ? box.max() : box.min())[cells.axis];
  }
  return box;
}

/// By whole cells: whether a cell is divided depends on all of it.
void Surfaces::forget_near(std::uint32_t shape, const Eigen::AlignedBox3d& box,
                           std::vector<std::uint32_t>& removed, Eigen::AlignedBox3d& around) {
  if (shapes_.size() <= shape || !shapes_[shape].form) return;
  Own& own = shapes_[shape];
  const Pose& pose = own.form->placement.pose;
  const Eigen::AlignedBox3d local = box_around(pose.inverse(), box);
  const auto forget = [&](const Lattice& cells, int layer, int u, int v, std::uint32_t& number) {
    if (number == kUnknown) return;
    const Eigen::AlignedBox3d cell = cell_box(*own.form, cells, layer, u, v);
    if (!local.intersects(cell)) return;
    forget_number(own, number, removed);
    around.extend(box_around(pose, cell));
  };
  std::size_t place = 0;
  for (const Lattice& cells : own.form->faces) {
    for (int layer = 0; layer < cells.layers; ++layer) {
      for (int v = 0; v < cells.rows; ++v) {
        for (int u = 0; u < cells.columns; ++u, ++place) {
          forget(cells, layer, u - 1, v - 1, own.cells[place]);
        }
      }
    }
  }
  for (const Key& key : own.far_keys) {
    forget(own.form->faces[static_cast<std::size_t>(key[1])], key[2], key[3], key[4],
           own.cells[place++]);
  }
}

void Surfaces::release(const std::vector<std::uint32_t>& removed) {
  free_.insert(free_.end(), removed.begin(), removed.end());
}

}  // namespace angen::light
