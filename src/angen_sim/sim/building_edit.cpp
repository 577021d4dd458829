// What changes models and lights that exist; building.cpp has what comes and goes.
#include <algorithm>
#include <utility>

#include "core/nearest.h"
#include "core/text.h"
#include "sim/building.h"

namespace angen::sim {

namespace {

// A black one is dark whatever its level is.
bool shines(const desc::Light& light) {
  return light.intensity > 0.0 && light.diffuse.maxCoeff() > 0.0F;
}

}  // namespace

void Building::note_placed(LiveModel& live) {
  if (std::find(placed_.begin(), placed_.end(), &live) == placed_.end()) placed_.push_back(&live);
}

std::vector<LiveModel*> Building::take_placed() { return std::exchange(placed_, {}); }

void Building::redescribe(LiveModel& live, desc::Model described) {
  engines_->physics.redescribe(live.parts.body, described);
  live.desc = std::make_shared<const desc::Model>(std::move(described));
  note_placed(live);
  note_change();
}

void Building::set_physics(const desc::Physics& physics, const Vec3& gravity) {
  const Nanoseconds step = physics_.step;
  physics_ = physics;
  physics_.step = step;
  gravity_ = gravity;
  engines_->physics.set(physics_, gravity_);
  note_change();
}

Building::FoundLight Building::find_light(const std::string& name) const {
  FoundLight found;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    found.own = i;
    if (lights_[i].light.name == name) return found;
    names.push_back(lights_[i].light.name);
  }
  found.own = SIZE_MAX;
  for (const auto& live : models_) {
    found.model = live.get();
    found.lamp = 0;
    for (found.link = 0; found.link < live->desc->links.size(); ++found.link) {
      const std::vector<desc::Light>& lights = live->desc->links[found.link].lights;
      for (found.in_link = 0; found.in_link < lights.size(); ++found.in_link, ++found.lamp) {
        names.push_back(live->desc->name + "::" + lights[found.in_link].name);
        if (names.back() == name) return found;
      }
    }
  }
  throw Error("no light named '" + printable(name) + "'; " + did_you_mean(name, names));
}

desc::Light Building::light(const std::string& name) const {
  const FoundLight found = find_light(name);
  if (found.model == nullptr) return lights_[found.own].light;
  const physics::LinkId link = found.model->parts.links[found.link];
  desc::Light light = found.model->desc->links[found.link].lights[found.in_link];
  light.pose = engines_->physics.link(link).pose * light.pose;
  return light;
}

void Building::set_light(const std::string& name, desc::Light light) {
  const FoundLight found = find_light(name);
  Parts::Lamp& lamp =
      found.model == nullptr ? lights_[found.own].lamp : found.model->parts.lamps[found.lamp];
  const desc::Light& old = found.model == nullptr
                               ? lights_[found.own].light
                               : found.model->desc->links[found.link].lights[found.in_link];
  Parts::Lamp made = engines_->add_light(light, light.pose);
  if (shines(old) && shines(light)) {  // what a device has set stays, of the new brightness
    made.level = lamp.level;
    engines_->light.set_level(made.id, engines_->light.level(lamp.id));
  }
  engines_->light.remove(lamp.id);
  made.link = lamp.link;
  if (found.model == nullptr) {
    lights_[found.own].light = std::move(light);
  } else {
    const Pose link = engines_->physics.link(found.model->parts.links[found.link]).pose;
    light.pose = made.offset = link.inverse() * light.pose;
    desc::Model described = *found.model->desc;
    described.links[found.link].lights[found.in_link] = std::move(light);
    found.model->desc = std::make_shared<const desc::Model>(std::move(described));
  }
  lamp = made;
  engines_->note_change();
  note_change();
}

std::vector<double> Building::light_levels() const {
  std::vector<double> levels(lights_.size(), 1.0);
  for (const auto& live : models_) {
    for (const Parts::Lamp& lamp : live->parts.lamps) levels.push_back(lamp.level);
  }
  return levels;
}

void Building::add_light(const desc::Light& light) {
  for (const WorldLight& own : lights_) {
    if (own.light.name != light.name) continue;
    throw Error(light.source, "light '" + light.name + "' exists already; choose another name");
  }
  lights_.push_back({light, engines_->add_light(light, light.pose)});
  engines_->note_change();
  note_change();
}

void Building::erase_light(const std::string& name) {
  const FoundLight found = find_light(name);
  if (found.model != nullptr) {
    throw Error("light '" + printable(name) + "' is a part of model '" + found.model->desc->name +
                "'; delete that");
  }
  engines_->light.remove(lights_[found.own].lamp.id);
  lights_.erase(lights_.begin() + static_cast<std::ptrdiff_t>(found.own));
  engines_->note_change();
  note_change();
}

}  // namespace angen::sim
