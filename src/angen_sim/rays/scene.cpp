#include "rays/scene.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/slots.h"
#include "rays/device.h"
#include "rays/query.h"
#include "rays/solid.h"

namespace angen::rays {
namespace {

struct Query {
  RTCIntersectContext context;  // first: Embree hands back its address
  Vec3 origin, direction;
  double min;
  Meeting best;        // range starts at the ray's max
  std::uint64_t rank;  // of the best so far; the lower wins a tie
  const Solid* solid;

  /// Static shapes before moving ones, then by index.
  static std::uint64_t rank_of(const Solid& solid, Mobility mobility) {
    return (mobility == Mobility::kMoving ? 1ULL << 32 : 0ULL) | solid.slot;
  }

  bool try_solid(const Solid& candidate, Mobility mobility) {
    Meeting found;
    if (!meet(candidate, origin, direction, min, best.range, found)) return false;
    const std::uint64_t found_rank = rank_of(candidate, mobility);
    if (found.range == best.range && found_rank >= rank) return false;
    best = found;
    rank = found_rank;
    solid = &candidate;
    return true;
  }
};

void bounds(const RTCBoundsFunctionArguments* args) {
  const auto* solids = static_cast<const Solid*>(args->geometryUserPtr);
  *args->bounds_o = padded(bounds_of(solids[args->primID]));
}

template <Mobility mobility>
void intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& q = *reinterpret_cast<Query*>(args->context);
  const auto* solids = static_cast<const Solid*>(args->geometryUserPtr);
  if (!q.try_solid(solids[args->primID], mobility)) return;
  reinterpret_cast<RTCRayHit*>(args->rayhit)->ray.tfar = reach(q.best.range);
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& q = *reinterpret_cast<Query*>(args->context);
  const auto* solids = static_cast<const Solid*>(args->geometryUserPtr);
  Meeting found;
  if (!meet(solids[args->primID], q.origin, q.direction, q.min, q.best.range, found)) return;
  q.solid = &solids[args->primID];
  reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
}

/// The shapes of one mobility: those with a box in a hierarchy, planes (which have none) beside it.
struct Layer {
  explicit Layer(RTCIntersectFunctionN intersect) : tree(bounds, intersect, occluded) {}

  std::vector<Solid> bounded;
  std::vector<Solid> planes;
  bool dirty = false;
  Hierarchy tree;

  void rebuild() {
    if (dirty) tree.build(bounded.data(), bounded.size());
    dirty = false;
  }

  std::vector<Solid>& list(Shape::Type type) {
    return type == Shape::Type::kPlane ? planes : bounded;
  }
};

struct Entry {
  Mobility mobility;
  Shape::Type type;
  Pose pose;
};

Solid make_solid(const Shape& shape, const Pose& pose) {
  Solid solid;
  solid.type = shape.type;
  solid.half =
      shape.type == Shape::Type::kBox ? Vec3(shape.size / 2) : Vec3(0, 0, shape.length / 2);
  solid.radius = shape.radius;
  solid.place(pose);
  return solid;
}

bool finite_as_floats(const Vec3& v) { return v.cast<float>().allFinite(); }

/// False for a ray that meets nothing by definition: not finite, no direction, an empty interval.
bool prepare(Query& q, const Vec3& origin, const Vec3& direction, double min, double max) {
  rtcInitIntersectContext(&q.context);
  q.origin = origin;
  q.direction = direction;
  q.min = std::max(0.0, min);
  q.best.range = max;
  q.rank = UINT64_MAX;
  q.solid = nullptr;
  const double length2 = direction.squaredNorm();
  return finite_as_floats(origin) && finite_as_floats(direction) && length2 > 1e-30 && q.min <= max;
}

}  // namespace

struct Scene::Impl {
  Slots<Entry, RayShapeTag> entries;
  std::vector<Eigen::Vector3f> reflectances;  // by index
  std::vector<std::uint32_t> places;          // by index: where in its layer's list
  std::vector<std::pair<ShapeId, WarmShape>> warmed;
  std::vector<WarmShape> warm;  // of these, as of the last commit
  Layer fixed{intersect<Mobility::kStatic>};
  Layer moving{intersect<Mobility::kMoving>};
  std::map<const TriangleMesh*, std::weak_ptr<const MeshTree>> meshes;
  std::uint64_t revision = 0;
  std::uint64_t static_revision = 0;

  Layer& layer(Mobility mobility) { return mobility == Mobility::kStatic ? fixed : moving; }

  std::shared_ptr<const MeshTree> mesh_tree(const std::shared_ptr<const TriangleMesh>& mesh) {
    if (!mesh) return nullptr;
    std::weak_ptr<const MeshTree>& known = meshes[mesh.get()];
    std::shared_ptr<const MeshTree> tree = known.lock();
    if (!tree) known = tree = std::make_shared<const MeshTree>(mesh);
    return tree;
  }

  void forget_unused_meshes() {
    for (auto it = meshes.begin(); it != meshes.end();) {
      it = it->second.expired() ? meshes.erase(it) : std::next(it);
    }
  }

  void bound_warm_shapes() {
    warm.clear();
    for (const auto& [id, shape] : warmed) {
      const Entry& entry = entries.at(id);
      warm.push_back(shape);
      warm.back().box = bounds_of(layer(entry.mobility).list(entry.type)[places[id.index]]);
    }
  }

  void nearest(Query& q) const {
    for (const Solid& plane : fixed.planes) q.try_solid(plane, Mobility::kStatic);
    for (const Solid& plane : moving.planes) q.try_solid(plane, Mobility::kMoving);
    RTCRayHit ray{};
    for (const Layer* layer : {&fixed, &moving}) {
      if (layer->bounded.empty()) continue;
      aim(ray.ray, q.origin, q.direction, q.min, q.best.range);
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(layer->tree.scene.get(), &q.context, &ray);
    }
  }

  bool any(Query& q) const {
    Meeting found;
    for (const Layer* layer : {&fixed, &moving}) {
      for (const Solid& plane : layer->planes) {
        if (meet(plane, q.origin, q.direction, q.min, q.best.range, found)) return true;
      }
      if (layer->bounded.empty()) continue;
      RTCRay ray{};
      aim(ray, q.origin, q.direction, q.min, q.best.range);
      rtcOccluded1(layer->tree.scene.get(), &q.context, &ray);
      if (q.solid != nullptr) return true;
    }
    return false;
  }
};

Scene::Scene() : impl_(std::make_unique<Impl>()) {}
Scene::~Scene() = default;

ShapeId Scene::add(const Shape& shape, const Pose& pose, Mobility mobility,
                   const Eigen::Vector3f& reflectance) {
  Solid solid = make_solid(shape, pose);
  if (shape.type == Shape::Type::kMesh) solid.mesh = impl_->mesh_tree(shape.mesh);
  const ShapeId id = impl_->entries.add({mobility, shape.type, pose});
  impl_->reflectances.resize(std::max<std::size_t>(impl_->reflectances.size(), id.index + 1));
  impl_->places.resize(impl_->reflectances.size());
  impl_->reflectances[id.index] = reflectance;
  if (shape.type == Shape::Type::kEmpty) return id;
  solid.slot = id.index;
  Layer& layer = impl_->layer(mobility);
  std::vector<Solid>& list = layer.list(shape.type);
  impl_->places[id.index] = static_cast<std::uint32_t>(list.size());
  list.push_back(std::move(solid));
  layer.dirty = true;
  return id;
}

void Scene::warm(ShapeId shape, double temperature) {
  const Entry& entry = impl_->entries.at(shape);
  if (entry.type == Shape::Type::kEmpty) return;
  impl_->warmed.push_back({shape, {shape.index, temperature, {}}});
  impl_->layer(entry.mobility).dirty = true;
}

void Scene::move(ShapeId shape, const Pose& pose) {
  Entry& entry = impl_->entries.at(shape);
  if (entry.pose == pose) return;
  entry.pose = pose;
  if (entry.type == Shape::Type::kEmpty) return;
  Layer& layer = impl_->layer(entry.mobility);
  layer.list(entry.type)[impl_->places[shape.index]].place(pose);
  layer.dirty = true;
}

void Scene::remove(ShapeId shape) {
  const Entry entry = impl_->entries.at(shape);
  impl_->entries.remove(shape);
  if (entry.type == Shape::Type::kEmpty) return;
  auto& warmed = impl_->warmed;
  warmed.erase(std::remove_if(warmed.begin(), warmed.end(),
                              [&](const auto& each) { return each.first == shape; }),
               warmed.end());
  Layer& layer = impl_->layer(entry.mobility);
  std::vector<Solid>& list = layer.list(entry.type);
  const std::uint32_t place = impl_->places[shape.index];
  if (place + 1 != list.size()) {
    list[place] = std::move(list.back());
    impl_->places[list[place].slot] = place;
  }
  list.pop_back();
  layer.dirty = true;
  if (entry.type == Shape::Type::kMesh) impl_->forget_unused_meshes();
}

void Scene::commit() {
  const bool static_changed = impl_->fixed.dirty;
  if (!static_changed && !impl_->moving.dirty) return;
  impl_->fixed.rebuild();
  impl_->moving.rebuild();
  impl_->bound_warm_shapes();
  ++impl_->revision;
  if (static_changed) ++impl_->static_revision;
}

void Scene::cast(const Ray* rays, Hit* hits, std::size_t count) const {
  Query q;
  for (std::size_t i = 0; i < count; ++i) {
    hits[i] = {};
    const Ray& ray = rays[i];
    if (!prepare(q, ray.origin, ray.direction, ray.min, ray.max)) continue;
    impl_->nearest(q);
    if (q.solid == nullptr) continue;
    const Vec3 normal = normal_at(*q.solid, q.origin, q.direction, q.best);
    hits[i] = {q.best.range, q.solid->slot, normal.cast<float>()};
  }
}

void Scene::cast(const std::vector<Ray>& rays, std::vector<Hit>& hits) const {
  hits.resize(rays.size());
  cast(rays.data(), hits.data(), rays.size());
}

bool Scene::blocked(const Vec3& from, const Vec3& to, double margin) const {
  Query q;
  const double length = (to - from).norm();
  const Vec3 direction = (to - from) / length;
  return prepare(q, from, direction, margin, length - margin) && impl_->any(q);
}

Eigen::Vector3f Scene::reflectance(std::uint32_t shape_index) const {
  return impl_->reflectances.at(shape_index);
}

const std::vector<WarmShape>& Scene::warm_shapes() const { return impl_->warm; }

std::uint64_t Scene::revision() const { return impl_->revision; }
std::uint64_t Scene::static_revision() const { return impl_->static_revision; }

}  // namespace angen::rays
