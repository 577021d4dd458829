#include "render/scene.h"

#include <limits>
#include <tuple>
#include <utility>

#include "core/parallel.h"
#include "core/slots.h"
#include "render/picture.h"
#include "render/reach.h"

namespace angen::render {
namespace {

struct Entry {
  Body body;
  std::uint32_t number = 0;  // in the instances, of a body with its own patch
  bool moved = false;
};

bool alone(const Body& body) { return body.moves || body.holds_lamp; }

bool equal(const PinholeCamera& a, const PinholeCamera& b) {
  const auto numbers = [](const PinholeCamera& camera) {
    const Distortion& d = camera.distortion;
    return std::make_tuple(camera.width, camera.height, camera.horizontal_angle, camera.near,
                           camera.far, d.k1, d.k2, d.p1, d.p2, d.k3);
  };
  return numbers(a) == numbers(b);
}

/// The hits of the last color image: depths of the same camera are usually requested next.
struct LastPicture {
  PinholeCamera camera;
  Pose pose;
  std::vector<float> depths;  // empty: none, or outdated
};

std::vector<float> no_depths(const PinholeCamera& camera) {
  return std::vector<float>(static_cast<std::size_t>(camera.width) * camera.height,
                            std::numeric_limits<float>::quiet_NaN());
}

}  // namespace

struct Scene::Impl {
  int threads;
  Slots<Entry, BodyTag> entries;
  Instances instances;
  Reaches reaches;      // of lamps among the bodies that do not move
  bool new_set = true;  // bodies were added or removed
  bool moved = false;
  LastPicture last;

  void rebuild() {
    instances.clear();
    std::vector<std::pair<const Body*, Pose>> still;
    entries.each([&](BodyId, Entry& entry) {
      entry.moved = false;
      if (!alone(entry.body)) {
        still.emplace_back(&entry.body, entry.body.pose);
      } else {
        auto patch = std::make_unique<Patch>(
            std::vector<std::pair<const Body*, Pose>>{{&entry.body, Pose{}}});
        entry.number = instances.add(std::move(patch), entry.body.pose, !entry.body.holds_lamp);
      }
    });
    const std::uint32_t fixed = instances.add(std::make_unique<Patch>(still), Pose{}, true);
    reaches.start(instances[fixed].patch->scene());
  }

  void prepare() {
    if (!new_set && !moved) return;
    last.depths.clear();
    if (new_set) {
      rebuild();
    } else {
      entries.each([&](BodyId, Entry& entry) {
        if (std::exchange(entry.moved, false)) instances.place(entry.number, entry.body.pose);
      });
    }
    instances.commit();
    new_set = moved = false;
  }
};

Scene::Scene(int threads) : impl_(std::make_unique<Impl>()) {
  impl_->threads = threads > 0 ? threads : processors();
}
Scene::~Scene() = default;

BodyId Scene::add(Body body) {
  impl_->new_set = true;
  return impl_->entries.add({std::move(body)});
}

void Scene::move(BodyId body, const Pose& pose) {
  Entry& entry = impl_->entries.at(body);
  if (entry.body.pose == pose) return;
  entry.body.pose = pose;
  entry.moved = impl_->moved = true;
  if (!alone(entry.body)) impl_->new_set = true;
}

void Scene::remove(BodyId body) {
  impl_->entries.remove(body);
  impl_->new_set = true;
}

std::vector<std::uint8_t> Scene::colors(const PinholeCamera& camera, const Pose& pose,
                                        const std::vector<light::Lit>& lamps,
                                        const Ambience& ambience) const {
  impl_->prepare();
  std::vector<std::uint8_t> pixels(3U * static_cast<std::size_t>(camera.width) * camera.height);
  std::vector<Box> reaches;
  reaches.reserve(lamps.size());
  for (const light::Lit& lit : lamps) reaches.push_back(impl_->reaches.of(lit.lamp));
  const Illumination by{lamps, reaches, ambience};
  impl_->last = {camera, pose, no_depths(camera)};
  trace(camera, pose, impl_->instances, impl_->threads, [&] {
    return std::make_unique<ColorWriter>(impl_->instances, by, camera.width, pixels.data(),
                                         impl_->last.depths.data());
  });
  return pixels;
}

std::vector<float> Scene::depths(const PinholeCamera& camera, const Pose& pose) const {
  impl_->prepare();
  const LastPicture& last = impl_->last;
  if (!last.depths.empty() && equal(last.camera, camera) && last.pose == pose) return last.depths;
  std::vector<float> values = no_depths(camera);
  trace(camera, pose, impl_->instances, impl_->threads,
        [&] { return std::make_unique<DepthWriter>(camera.width, values.data()); });
  return values;
}

}  // namespace angen::render
