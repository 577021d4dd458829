#include "rays/scene.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>
#include <utility>

#include "core/lists.h"
#include "core/slots.h"
#include "rays/layer.h"
#include "rays/nearby.h"
#include "rays/shaft.h"
#include "rays/triangle_tree.h"

namespace angen::rays {
namespace {

/// Another one than those of all scenes of this process.
std::uint64_t new_revision() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

constexpr std::size_t kMaxChanges = 4096;
constexpr std::size_t kMaxMoves = 1024;
constexpr double kRim = 2e-3;  // m: a shape that reaches less into a target's box does not block

struct Entry {
  Mobility mobility;
  Shape::Type type;
  Pose pose;
};

/// Position of a shape in its layer's lists, or the last one of a removed shape; no layer if empty.
struct Place {
  ShapeId id;
  Layer* layer = nullptr;
  Shape::Type type = Shape::Type::kEmpty;
  std::uint32_t at = 0;
  std::uint64_t noted = 0;  // mark of its latest entry in `changes`; 0 without one
};

/// m, world; infinite for a plane.
Eigen::AlignedBox3d box_of(const Solid& solid) {
  if (solid.type != Shape::Type::kPlane) return solid.box;
  const Vec3 corner = Vec3::Constant(std::numeric_limits<double>::infinity());
  return {-corner, corner};
}

ShaftHull hull_to(const Solid& target, const Vec3& from, double near) {
  const Vec3 rim = (0.25 * target.box.sizes()).cwiseMin(kRim);
  return {from, near, {target.box.min() + rim, target.box.max() - rim}};
}

Solid make_solid(const Shape& shape, std::shared_ptr<const TriangleTree> mesh, const Pose& pose) {
  Solid solid;
  const bool is_mesh = shape.type == Shape::Type::kHeightmap;
  solid.type = is_mesh ? Shape::Type::kMesh : shape.type;
  solid.half =
      shape.type == Shape::Type::kBox ? Vec3(shape.size / 2) : Vec3(0, 0, shape.length / 2);
  solid.radius = shape.radius;
  solid.mesh = std::move(mesh);
  solid.place(pose);
  return solid;
}

}  // namespace

struct Scene::Impl {
  Slots<Entry, RayShapeTag> entries;
  std::vector<Eigen::Vector3f> reflectances;  // by index
  std::vector<Place> places;                  // by index
  std::vector<std::pair<ShapeId, WarmShape>> warmed;
  std::vector<WarmShape> warm;                                    // in use since the last commit
  std::map<std::uint32_t, std::pair<Shape::Type, Solid>> hidden;  // by index
  Layer fixed{true};
  Layer moving{false};
  std::uint64_t placements = 0;
  std::uint64_t revision = 0;
  std::uint64_t static_revision = 0;
  bool warm_dirty = false;
  std::vector<std::uint32_t> changes;      // indices of changed standing shapes, the latest last
  std::uint64_t forgotten = 1;             // mark of the first entry in `changes`
  mutable std::uint64_t read = 1;          // the latest mark given out
  std::vector<Eigen::AlignedBox3d> moves;  // boxes of moved shapes, before and after
  std::uint64_t moves_forgotten = 0;       // the moment of the first entry in `moves`

  void put_in(ShapeId id, Solid solid) {
    const Entry& entry = entries.at(id);
    solid.placed = ++placements;
    solid.anchored = entry.mobility == Mobility::kAnchored;
    note_move(solid);
    Layer& into = layer(entry.mobility);
    std::vector<Solid>& list = into.list(entry.type);
    places[id.index] = {id, &into, entry.type, static_cast<std::uint32_t>(list.size())};
    list.push_back(std::move(solid));
    touch(id.index, entry.mobility);
  }

  /// A standing solid of another scene.
  void copy_in(const Place& place, const Solid& solid) {
    std::vector<Solid>& list = fixed.list(place.type);
    places[solid.slot] = {place.id, &fixed, place.type, static_cast<std::uint32_t>(list.size())};
    list.push_back(solid);
    list.back().loose = false;
  }

  Solid take_out(ShapeId id) {
    const Entry& entry = entries.at(id);
    std::vector<Solid>& list = layer(entry.mobility).list(entry.type);
    const std::uint32_t at = places[id.index].at;
    std::swap(list[at], list.back());
    places[list[at].slot].at = at;
    Solid solid = std::move(list.back());
    list.pop_back();
    note_move(solid);
    touch(id.index, entry.mobility);
    return solid;
  }

  void note_move(const Solid& solid) {
    if (moves.size() == 2 * kMaxMoves) {
      moves.erase(moves.begin(), moves.begin() + kMaxMoves);
      moves_forgotten += kMaxMoves;
    }
    moves.push_back(box_of(solid));
  }

  void touch(std::uint32_t index, Mobility mobility) {
    layer(mobility).change(Changed::kAny);
    if (mobility != Mobility::kMoving) note_standing(index);
  }

  void note_standing(std::uint32_t index) {
    std::uint64_t& noted = places[index].noted;
    if (noted >= read) return;  // not read since
    if (changes.size() == 2 * kMaxChanges) {
      changes.erase(changes.begin(), changes.begin() + kMaxChanges);
      forgotten += kMaxChanges;
    }
    noted = forgotten + changes.size();
    changes.push_back(index);
  }

  void prepare(Mobilities among) const {
    for (const Layer* layer : {&fixed, &moving}) {
      if (layer->holds(among)) layer->prepare(among);
    }
  }

  Layer& layer(Mobility mobility) { return mobility == Mobility::kStatic ? fixed : moving; }

  void bound_warm_shapes() {
    warm.clear();
    for (const auto& [id, shape] : warmed) {
      if (hidden.count(id.index) != 0) continue;
      warm.push_back(shape);
      const Solid& placed = solid(id.index);
      warm.back().box = placed.box;
      warm.back().rotation = placed.rotation;
    }
  }

  const Solid& solid(std::uint32_t index) const {
    const Place& place = places.at(index);
    return place.layer->list(place.type)[place.at];
  }

  void nearest(SceneQuery& q, Mobilities among) const {
    for (const Layer* layer : {&fixed, &moving}) {
      if (layer->holds(among)) layer->nearest(q);
    }
  }

  bool any(SceneQuery& q, Mobilities among) const {
    return (fixed.holds(among) && fixed.any(q)) || (moving.holds(among) && moving.any(q));
  }
};

Scene::Scene() : impl_(std::make_unique<Impl>()) {}
Scene::~Scene() = default;

ShapeId Scene::add(const Shape& shape, const Pose& pose, Mobility mobility,
                   const Eigen::Vector3f& reflectance) {
  std::shared_ptr<const TriangleTree> mesh;
  if (shape.type == Shape::Type::kMesh) mesh = TriangleTree::of(shape.mesh);
  if (shape.type == Shape::Type::kHeightmap) mesh = TriangleTree::of(shape.heights);
  Solid solid = make_solid(shape, std::move(mesh), pose);
  const ShapeId id = impl_->entries.add({mobility, solid.type, pose});
  impl_->reflectances.resize(std::max<std::size_t>(impl_->reflectances.size(), id.index + 1));
  impl_->places.resize(impl_->reflectances.size());
  impl_->reflectances[id.index] = reflectance;
  impl_->places[id.index] = {};
  if (shape.type == Shape::Type::kEmpty) return id;
  solid.slot = id.index;
  impl_->put_in(id, std::move(solid));
  return id;
}

void Scene::warm(ShapeId shape, const Warming& course) {
  const Entry& entry = impl_->entries.at(shape);
  if (entry.type == Shape::Type::kEmpty && impl_->hidden.count(shape.index) == 0) return;
  auto& warmed = impl_->warmed;
  const auto known = std::find_if(warmed.begin(), warmed.end(),
                                  [&](const auto& each) { return each.first == shape; });
  if (known == warmed.end()) {
    warmed.push_back({shape, {shape.index, course, {}}});
  } else if (known->second.course == course) {
    return;
  } else {
    known->second.course = course;
  }
  impl_->warm_dirty = true;
}

void Scene::move(ShapeId shape, const Pose& pose) {
  Entry& entry = impl_->entries.at(shape);
  if (entry.pose == pose) return;
  entry.pose = pose;
  if (entry.type == Shape::Type::kEmpty) return;
  Layer& layer = impl_->layer(entry.mobility);
  Solid& solid = layer.list(entry.type)[impl_->places[shape.index].at];
  impl_->note_move(solid);
  solid.place(pose);
  impl_->note_move(solid);
  solid.placed = ++impl_->placements;
  if (entry.mobility == Mobility::kMoving && entry.type != Shape::Type::kPlane) {
    layer.move(impl_->places[shape.index].at);
  } else {
    impl_->touch(shape.index, entry.mobility);
  }
}

void Scene::set_anchored(ShapeId shape, bool anchored) {
  Entry& entry = impl_->entries.at(shape);
  const Mobility mobility = anchored ? Mobility::kAnchored : Mobility::kMoving;
  if (entry.mobility == mobility || entry.mobility == Mobility::kStatic) return;
  entry.mobility = mobility;
  if (entry.type == Shape::Type::kEmpty) return;
  impl_->moving.list(entry.type)[impl_->places[shape.index].at].anchored = anchored;
  impl_->touch(shape.index, Mobility::kAnchored);
}

void Scene::show(ShapeId shape, bool shown) {
  Entry& entry = impl_->entries.at(shape);
  const auto hidden = impl_->hidden.find(shape.index);
  if (shown && hidden != impl_->hidden.end()) {
    entry.type = hidden->second.first;
    hidden->second.second.place(entry.pose);
    impl_->put_in(shape, std::move(hidden->second.second));
    impl_->hidden.erase(hidden);
  } else if (!shown && entry.type != Shape::Type::kEmpty) {
    impl_->hidden.emplace(shape.index, std::pair(entry.type, impl_->take_out(shape)));
    impl_->places[shape.index].layer = nullptr;
    entry.type = Shape::Type::kEmpty;
  } else {
    return;
  }
  impl_->warm_dirty = true;
}

bool Scene::is_hidden(ShapeId shape) const {
  return !impl_->hidden.empty() && impl_->hidden.count(shape.index) != 0;
}

void Scene::remove(ShapeId shape) {
  show(shape, true);
  const Entry entry = impl_->entries.at(shape);
  if (entry.type != Shape::Type::kEmpty) impl_->take_out(shape);
  impl_->entries.remove(shape);
  if (entry.type == Shape::Type::kEmpty) return;
  auto& warmed = impl_->warmed;
  erase_if(warmed, [&](const auto& each) { return each.first == shape; });
}

void Scene::commit() {
  const bool moved = impl_->fixed.changed() || impl_->moving.changed();
  if (!moved && !impl_->warm_dirty) return;
  impl_->warm_dirty = false;
  if (!moved) {
    impl_->bound_warm_shapes();
    return;
  }
  if (impl_->fixed.changed()) impl_->static_revision = new_revision();
  impl_->fixed.commit();
  impl_->moving.commit();
  impl_->bound_warm_shapes();
  ++impl_->revision;
}

void Scene::cast(const Ray* rays, Hit* hits, std::size_t count, Mobilities among) const {
  SceneQuery q;
  impl_->prepare(among);
  for (std::size_t i = 0; i < count; ++i) {
    hits[i] = {};
    if (!q.prepare(rays[i], among)) continue;
    impl_->nearest(q, among);
    if (q.solid != nullptr) hits[i] = q.hit();
  }
}

void Scene::cast(const std::vector<Ray>& rays, std::vector<Hit>& hits, Mobilities among) const {
  hits.resize(rays.size());
  cast(rays.data(), hits.data(), rays.size(), among);
}

void Scene::better(ShapeId moving, const Ray& ray, Hit& hit) const {
  SceneQuery q;
  const Entry& entry = impl_->entries.at(moving);
  if (entry.type == Shape::Type::kEmpty || !q.prepare(ray, kAll)) return;
  if (hit.hit()) {
    q.best.range = hit.range;
    q.rank = SceneQuery::rank_of(hit.shape, impl_->places[hit.shape].layer == &impl_->fixed);
  }
  if (q.try_solid(impl_->solid(moving.index), false)) hit = q.hit();
}

Eigen::AlignedBox3d Scene::bounds(ShapeId shape) const {
  if (impl_->entries.at(shape).type == Shape::Type::kEmpty) return {};
  return box_of(impl_->solid(shape.index));
}

bool Scene::blocked(const Vec3& from, const Vec3& to, double margin, Mobilities among) const {
  SceneQuery q;
  impl_->prepare(among);
  return q.prepare_between(from, to, margin, among) && impl_->any(q, among);
}

Nearby Scene::near(const Eigen::AlignedBox3d& box) const {
  constexpr Mobilities kStanding = kAll & ~only(Mobility::kMoving);
  impl_->prepare(kStanding);
  Nearby found;
  for (const Layer* layer : {&impl_->fixed, &impl_->moving}) {
    layer->find_near(box, [&](const Solid& solid) {
      if (layer->fixed || solid.anchored) found.solids_.push_back(&solid);
    });
    for (const Solid& plane : layer->planes) {
      if (layer->fixed || plane.anchored) found.solids_.push_back(&plane);
    }
  }
  return found;
}

std::shared_ptr<const Scene> Scene::standing_scene() const {
  auto copy = std::make_shared<Scene>();
  Impl& to = *copy->impl_;
  to.entries = impl_->entries;
  to.reflectances = impl_->reflectances;
  to.places.resize(impl_->places.size());
  to.fixed.held |= only(Mobility::kAnchored);
  for (const Layer* layer : {&impl_->fixed, &impl_->moving}) {
    for (const std::vector<Solid>* list : {&layer->bounded, &layer->planes}) {
      for (const Solid& solid : *list) {
        if (layer->fixed || solid.anchored) to.copy_in(impl_->places[solid.slot], solid);
      }
    }
  }
  to.fixed.change(Changed::kAny);
  copy->commit();
  return copy;
}

Shaft Scene::shaft(const Vec3& from, double near, std::uint32_t shape_index) const {
  impl_->prepare(kAll);
  const Solid& target = impl_->solid(shape_index);
  const ShaftHull hull = hull_to(target, from, near);
  std::vector<Shaft::Blocker> blockers;
  for (const Layer* layer : {&impl_->fixed, &impl_->moving}) {
    layer->find_in(hull, [&](const Solid& solid) {
      if (&solid != &target) blockers.push_back({&solid, layer->fixed});
    });
  }
  const bool is_fixed = impl_->places[shape_index].layer == &impl_->fixed;
  return {hull, {&target, is_fixed}, std::move(blockers)};
}

bool Scene::blocks(std::uint32_t by_index, const Vec3& from, double near,
                   std::uint32_t shape_index) const {
  if (by_index >= impl_->places.size() || impl_->places[by_index].layer == nullptr) return false;
  const Place& by = impl_->places[by_index];
  if (by_index == shape_index || !impl_->entries.contains(by.id)) return false;
  const ShaftHull hull = hull_to(impl_->solid(shape_index), from, near);
  return hull.overlaps(impl_->solid(by_index)) && hull.is_cut_by(impl_->solid(by_index));
}

std::uint64_t Scene::moment() const { return impl_->moves_forgotten + impl_->moves.size(); }

bool Scene::moved_since(std::uint64_t moment, const Eigen::AlignedBox3d& box) const {
  if (moment < impl_->moves_forgotten) return true;
  const auto first = static_cast<std::ptrdiff_t>(moment - impl_->moves_forgotten);
  return std::any_of(impl_->moves.begin() + first, impl_->moves.end(),
                     [&](const Eigen::AlignedBox3d& moved) { return moved.intersects(box); });
}

Hit Scene::cast_at(std::uint32_t shape_index, const Ray& ray) const {
  SceneQuery q;
  if (impl_->places.at(shape_index).layer == nullptr || !q.prepare(ray, kAll)) return {};
  return q.try_solid(impl_->solid(shape_index), true) ? q.hit() : Hit{};
}

bool Scene::covered(const Vec3& point, std::uint32_t except) const {
  impl_->prepare(kAll & ~only(Mobility::kMoving));
  return impl_->fixed.covers(point, except) || impl_->moving.covers(point, except);
}

std::int64_t Scene::price(const Vec3& point) const {
  constexpr std::int64_t kUsual = 16;  // ordinary rooms have less
  impl_->prepare(kAll & ~only(Mobility::kMoving));
  return 1 + std::max<std::int64_t>(
                 0, (impl_->fixed.crowd(point) + impl_->moving.crowd(point)) / kTenths - kUsual);
}

Eigen::Vector3f Scene::reflectance(std::uint32_t shape_index) const {
  return impl_->reflectances.at(shape_index);
}

const std::vector<WarmShape>& Scene::warm_shapes() const { return impl_->warm; }
Mobility Scene::mobility(std::uint32_t shape_index) const {
  const Place& place = impl_->places.at(shape_index);
  if (place.layer == nullptr) return Mobility::kMoving;  // empty
  return SceneQuery::mobility_of(impl_->solid(shape_index), place.layer->fixed);
}

Placement Scene::placement(std::uint32_t shape_index) const {
  const Solid& solid = impl_->solid(shape_index);
  return {solid.type, {solid.position, Quat(solid.rotation)}, own_box(solid)};
}

Eigen::AlignedBox3d Scene::static_bounds() const {
  Eigen::AlignedBox3d all;
  for (const Solid& solid : impl_->fixed.bounded) {
    if (!solid.anchored) all.extend(solid.box);
  }
  return all;
}

std::optional<Standing> Scene::standing(std::uint32_t index) const {
  if (index >= impl_->places.size()) return std::nullopt;
  const Place& place = impl_->places[index];
  if (place.layer == nullptr || !impl_->entries.contains(place.id)) return std::nullopt;
  const Mobility is = mobility(index);
  if (is == Mobility::kMoving) return std::nullopt;
  return Standing{place.id, is == Mobility::kStatic, bounds(place.id)};
}

std::vector<std::uint32_t> Scene::standing_changes(std::uint64_t& mark) const {
  const std::uint64_t known = std::exchange(mark, impl_->forgotten + impl_->changes.size());
  impl_->read = mark;
  std::vector<std::uint32_t> indices;
  if (known < impl_->forgotten) {
    indices.resize(impl_->places.size());
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
  }
  const auto first = static_cast<std::ptrdiff_t>(known - impl_->forgotten);
  indices.assign(impl_->changes.begin() + first, impl_->changes.end());
  sort_unique(indices);
  return indices;
}

std::uint64_t Scene::revision() const { return impl_->revision; }
std::uint64_t Scene::static_revision() const { return impl_->static_revision; }

}  // namespace angen::rays
