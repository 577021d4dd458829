#pragma once

#include <climits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "angen_sim/fakes.h"
#include "plugin/library.h"
#include "rays/scene.h"

/// One sensor out of its library, in a scene of its own.
namespace angen::test {

inline Shape box(double x, double y, double z) {
  Shape shape;
  shape.type = Shape::Type::kBox;
  shape.size = {x, y, z};
  return shape;
}

inline Pose at(double x, double y = 0.0, double z = 0.0) { return {{x, y, z}, Quat::Identity()}; }

/// <scan>'s <horizontal> or <vertical>.
inline Element scan(const std::string& name, int samples, double min, double max) {
  return element(
      name, "",
      {element("samples", std::to_string(samples)), element("min_angle", std::to_string(min)),
       element("max_angle", std::to_string(max))});
}

inline Element noise(double stddev) {
  return element("noise", "",
                 {element("type", "gaussian"), element("mean", "0"),
                  element("stddev", std::to_string(stddev))});
}

/// <sensor> of `children`, for a bench.
inline Element sensor_element(std::vector<Element> children) {
  return element("sensor", "", std::move(children));
}

class Bench {
 public:
  explicit Bench(const std::string& library, const Element& plugin = element("plugin"),
                 const Element& sensor = element("sensor"), FakeWorld filled = {})
      : world(std::move(filled)),
        plugin_(plugin_of(library)),
        params_(plugin, &sensor, plugin_->kind().rate()) {
    sensor_ = plugin_->make_sensor(params_);
    sensor_->configure(params_, world);
    params_.finish();
  }

  rays::ShapeId add(const Shape& shape, const Pose& pose) {
    return scene.add(shape, pose, rays::Mobility::kMoving, albedo);
  }

  /// Samples once at world.now, then lets `period` pass.
  Reading sample(Nanoseconds period = 100'000'000) {
    scene.commit();
    world.revisions.shapes = scene.revision() + moves;
    world.scene = &scene;
    RayBatch batch;
    sensor_->ray_set(world);
    sensor_->aim(world, batch);
    std::vector<rays::Hit> hits;
    scene.cast(batch, hits);
    Rng rng(seed, hash_bytes("sensor"), world.now / world.dt);
    Reading reading;
    sensor_->read(world, {hits.data(), hits.size()}, rng, reading);
    if (!params_.all_noise().empty()) {
      const Rng draws(seed, hash_bytes("sensor"), world.now / world.dt);
      reading = with_noise(params_.all_noise(), reading, draws);
    }
    world.now += period;
    rays_cast = std::move(batch);
    return reading;
  }

  const Sensor& sensor() const { return *sensor_; }
  /// When a sample may next be another; none has noise that matters.
  Nanoseconds idle_until() const {
    struct Silent : Ahead {
      int unchanged() const override { return INT_MAX; }
      Nanoseconds first_loud(double) const override { return kForever; }
    };
    return sensor_->idle_until(Silent{});
  }
  const Kind& kind() const { return plugin_->kind(); }

  FakeWorld world;
  rays::Scene scene;
  RayBatch rays_cast;  // of the last sample
  std::uint64_t seed = 1;
  std::uint64_t moves = 0;                                   // of which the scene does not know
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.7F);  // of the shapes to add

 private:
  static std::shared_ptr<const Plugin> plugin_of(const std::string& library) {
    static Catalog catalog;
    return catalog.library(library).at(0);
  }

  std::shared_ptr<const Plugin> plugin_;
  Params params_;
  std::unique_ptr<Sensor> sensor_;
};

/// The error of configuring such a sensor, "" without one.
inline std::string complaint_of(const std::string& library, const Element& plugin,
                                const Element& sensor = element("sensor"),
                                const FakeWorld& filled = {}) {
  try {
    const Bench bench(library, plugin, sensor, filled);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace angen::test
