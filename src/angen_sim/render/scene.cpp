#include "render/scene.h"

#include <algorithm>
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

bool equal(const Ambience& a, const Ambience& b) {
  return a.ambient == b.ambient && a.background == b.background && a.reflected == b.reflected;
}

bool equal(const light::Lit& a, const light::Lit& b) {
  const auto values = [](const light::Lit& lit) {
    const light::Lamp& l = lit.lamp;
    return std::tie(lit.level, l.type, l.pose, l.direction, l.luminous_flux, l.color, l.radius,
                    l.width, l.height, l.length, l.half_angle, l.inner_angle, l.outer_angle,
                    l.photometry, l.photometric_flux, l.cast_shadows);
  };
  return values(a) == values(b);
}

/// A color image with its depths, and all that it shows besides the bodies.
struct Picture {
  PinholeCamera camera;
  Pose pose;
  std::vector<light::Lit> lamps;
  Ambience ambience;
  std::vector<std::uint8_t> colors;
  std::vector<float> depths;

  std::size_t bytes() const { return colors.size() + sizeof(float) * depths.size(); }
  bool is_from(const PinholeCamera& other, const Pose& from) const {
    return equal(camera, other) && pose == from;
  }
  bool is_under(const std::vector<light::Lit>& others, const Ambience& other) const {
    return equal(ambience, other) &&
           std::equal(lamps.begin(), lamps.end(), others.begin(), others.end(),
                      [](const light::Lit& a, const light::Lit& b) { return equal(a, b); });
  }
};

/// The last picture of each of some cameras, until a body changes: the depths of a color image are
/// usually requested next, and a camera at rest shows the same again.
class Pictures {
 public:
  /// Null without one.
  const Picture* find(const PinholeCamera& camera, const Pose& pose) const {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const Picture& picture) {
      return picture.is_from(camera, pose);
    });
    return found == all_.end() ? nullptr : &*found;
  }
  /// Replaces that of the same camera; drops the oldest ones while all take too many bytes.
  void add(Picture picture) {
    const auto same = std::find_if(all_.begin(), all_.end(), [&](const Picture& other) {
      return other.is_from(picture.camera, picture.pose);
    });
    if (same != all_.end()) all_.erase(same);
    all_.push_back(std::move(picture));
    std::size_t bytes = 0;
    for (const Picture& each : all_) bytes += each.bytes();
    while (bytes > kMaxBytes && all_.size() > 1) {
      bytes -= all_.front().bytes();
      all_.erase(all_.begin());
    }
  }
  void clear() { all_.clear(); }

 private:
  static constexpr std::size_t kMaxBytes = 16U << 20U;  // the newest may be larger

  std::vector<Picture> all_;  // in the order of their rendering
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
  Reaches reaches;      // reaches of lamps among the bodies that do not move
  bool new_set = true;  // bodies were added or removed
  bool moved = false;
  Pictures last;

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
    instances.set_fixed(std::make_unique<Patch>(still));
    reaches.start(instances.fixed().scene());
  }

  void prepare() {
    if (!new_set && !moved) return;
    last.clear();
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
  const Picture* last = impl_->last.find(camera, pose);
  if (last != nullptr && last->is_under(lamps, ambience)) return last->colors;
  std::vector<std::uint8_t> pixels(3U * static_cast<std::size_t>(camera.width) * camera.height);
  std::vector<float> depths = no_depths(camera);
  std::vector<Box> reaches;
  reaches.reserve(lamps.size());
  for (const light::Lit& lit : lamps) reaches.push_back(impl_->reaches.of(lit.lamp));
  const Illumination by{lamps, reaches, ambience};
  trace(camera, pose, impl_->instances, impl_->threads, [&] {
    return std::make_unique<ColorWriter>(impl_->instances, by, camera.width, pixels.data(),
                                         depths.data());
  });
  impl_->last.add({camera, pose, lamps, ambience, pixels, std::move(depths)});
  return pixels;
}

std::vector<float> Scene::depths(const PinholeCamera& camera, const Pose& pose) const {
  impl_->prepare();
  const Picture* last = impl_->last.find(camera, pose);
  if (last != nullptr) return last->depths;
  std::vector<float> values = no_depths(camera);
  trace(camera, pose, impl_->instances, impl_->threads,
        [&] { return std::make_unique<DepthWriter>(camera.width, values.data()); });
  return values;
}

}  // namespace angen::render
