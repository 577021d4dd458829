// Changes of models and lights that exist; building.cpp adds and removes them.
#include <utility>

#include "core/lists.h"
#include "core/nearest.h"
#include "core/text.h"
#include "desc/own_lamp.h"
#include "sim/building.h"
#include "sim/device_maker.h"

namespace angen::sim {

void Building::note_placed(LiveModel& live) {
  if (!is_in(&live, placed_)) placed_.push_back(&live);
}

const std::vector<LiveModel*>& Building::note_awake(std::int64_t tick) {
  awake_links_.clear();
  awake_.clear();
  engines_->physics.list_awake(awake_links_);
  for (const physics::LinkId link : awake_links_) {
    LiveModel& live = *owner(link).model;
    if (live.awake_at == tick) continue;
    live.awake_at = tick;
    awake_.push_back(&live);
    note_moved(live, engines_->movers.now() + 1);
  }
  return awake_;
}

void Building::note_moved(LiveModel& live, MoverIndex::Moment when) const {
  if (live.changed >= when) return;
  live.changed = when;
  note_states(live, when);
}

std::vector<LiveModel*> Building::take_placed() { return std::exchange(placed_, {}); }

void Building::redescribe(LiveModel& live, desc::Model described) {
  engines_->physics.redescribe(live.parts.body, described);
  live.desc = std::make_shared<const desc::Model>(std::move(described));
  note_placed(live);
  note_change(number_of(live));
}

void Building::set_physics(const desc::Physics& physics, const Vec3& gravity) {
  const Nanoseconds step = physics_.step;
  physics_ = physics;
  physics_.step = step;
  gravity_ = gravity;
  engines_->physics.set(physics_, gravity_);
  for (const auto& live : models_) note_moved(*live);
  note_change(models_.size());
}

Building::FoundLight Building::find_light(const std::string& name) const {
  FoundLight found;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    found.live = lights_[i].live.get();
    found.own = i;
    if (lights_[i].light().name == name) return found;
    names.push_back(lights_[i].light().name);
  }
  found.own = SIZE_MAX;
  for (const auto& live : models_) {
    found.live = live.get();
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
  desc::Light light = found.live->desc->links[found.link].lights[found.in_link];
  if (!found.live->is_light) {
    light.pose = engines_->physics.pose(found.live->parts.links[found.link]) * light.pose;
  }
  return light;
}

void Building::set_light(const std::string& name, desc::Light light) {
  const FoundLight found = find_light(name);
  LiveModel& live = *found.live;
  Parts::Lamp& lamp = live.parts.lamps[found.lamp];
  desc::Model described = *live.desc;
  desc::Light& old = described.links[found.link].lights[found.in_link];
  const bool stays = desc::shines(old) && desc::shines(light);
  Parts::Lamp made = engines_->add_light(light, light.pose);
  if (stays) {  // the level that a device has set, of the new brightness
    made.level = lamp.level;
    engines_->light.set_level(made.id, engines_->light.level(lamp.id));
  }
  engines_->light.remove(lamp.id);
  made.link = lamp.link;
  if (!live.is_light) {
    const Pose link = engines_->physics.pose(live.parts.links[found.link]);
    light.pose = made.offset = link.inverse() * light.pose;
  }
  old = std::move(light);
  live.desc = std::make_shared<const desc::Model>(std::move(described));
  lamp = made;
  for (DeviceInstance& device : live.devices) {
    if (device.own_light != static_cast<int>(found.lamp)) continue;
    remake_own_lamp(live, device, stays, *catalog_, warnings_);
  }
  engines_->note_change();
  note_change(0);
}

Building::WorldLight Building::world_light(const desc::Light& light, const std::string& sdf) const {
  desc::Model model;
  model.name = light.name;
  model.is_static = true;
  model.customs = world_.customs;
  model.source = light.source;
  model.links.emplace_back();
  model.links[0].lights = {light};
  auto live = std::make_unique<LiveModel>();
  live->desc = live->read = std::make_shared<const desc::Model>(std::move(model));
  live->is_light = true;
  return {std::move(live), sdf};
}

void Building::put_light(WorldLight& own) {
  own.live->parts.lamps = {engines_->add_light(own.light(), own.light().pose)};
}

void Building::make_lamp(LiveModel& light, Nanoseconds now) {
  make_devices(light, {}, *catalog_, warnings_);
  drop_taken_lamps(light);
  for (DeviceInstance& device : light.devices) device.updated = now - world_.physics.step;
  registry_.add(light);
}

// A light whose lamp would have the name of another shines, and is not switched.
void Building::drop_taken_lamps(LiveModel& live) {
  const auto is_taken = [&](const DeviceInstance& device) {
    if (device.own_light < 0 || !registry_.with_device(device.kind, device.name)) return false;
    const std::string text = "light '" + device.name + "' cannot be switched: there is a " +
                             device.kind + " of that name; give it another name";
    warnings_.push_back(
        Diagnostic{Diagnostic::Severity::kWarning, device.element.source, text}.text());
    return true;
  };
  erase_if(live.devices, is_taken);
}

void Building::add_light(const desc::Light& light, const std::string& sdf, Nanoseconds now) {
  for (const WorldLight& own : lights_) {
    if (own.light().name != light.name) continue;
    throw Error(light.source, "light '" + light.name + "' exists already; choose another name");
  }
  lights_.push_back(world_light(light, sdf));
  put_light(lights_.back());
  make_lamp(*lights_.back().live, now);
  engines_->note_change();
  note_change(0);
}

void Building::erase_light(const std::string& name) {
  const FoundLight found = find_light(name);
  if (!found.live->is_light) {
    throw Error("light '" + printable(name) + "' is a part of model '" + found.live->desc->name +
                "'; delete that");
  }
  engines_->light.remove(found.live->parts.lamps[0].id);
  registry_.remove(*found.live);
  lights_.erase(lights_.begin() + static_cast<std::ptrdiff_t>(found.own));
  engines_->note_change();
  note_change(0);
}

}  // namespace angen::sim
