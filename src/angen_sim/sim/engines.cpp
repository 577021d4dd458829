#include "sim/engines.h"

#include <algorithm>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "desc/own_lamp.h"
#include "light/photometry.h"
#include "sim/joined.h"
#include "sim/like_visual.h"

namespace angen::sim {

namespace {

constexpr float kNight = 0.1F;  // of SDF's ambient: the light of a dark world for cameras

Eigen::Vector3f with_luminance_one(const Eigen::Vector3f& color) {
  const float luminance = Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F).dot(color);  // Rec. 709
  return luminance > 0.0F ? Eigen::Vector3f(color / luminance) : Eigen::Vector3f::Ones();
}

// A door is, and the leaf's handles; a robot is not.
std::set<std::string> links_joined_to_world(const desc::Model& model) {
  return joined_to({"world"}, model, false, [](const desc::Joint&) { return true; });
}

std::vector<std::vector<std::uint32_t>> joints_by_child(const desc::Model& model) {
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < model.links.size(); ++i) index.emplace(model.links[i].name, i);
  std::vector<std::vector<std::uint32_t>> joints(model.links.size());
  for (std::uint32_t i = 0; i < model.joints.size(); ++i) {
    const auto child = index.find(model.joints[i].child);
    if (child != index.end()) joints[child->second].push_back(i);
  }
  return joints;
}

// Glass and the like, which lets more than half of the light through, is not seen. Limbs of people
// are bodies of their own.
render::Body visible(const desc::Link& link, const Pose& pose, bool moves, int limb = kNoLimb) {
  render::Body body;
  body.pose = pose;
  body.moves = moves;
  body.holds_lamp = !link.lights.empty();
  for (const desc::Visual& visual : link.visuals) {
    const desc::Material& material = visual.material;
    if (material.diffuse.w() < 0.5F) continue;
    if (link.upright && limb_of(visual.name) != limb) continue;
    body.surfaces.push_back({visual.shape, visual.pose, material.diffuse.head<3>(),
                             body.holds_lamp ? Eigen::Vector3f(0.0F, 0.0F, 0.0F)
                                             : Eigen::Vector3f(material.emissive.head<3>()),
                             material.look, material.textures});
  }
  return body;
}

}  // namespace

Engines::Engines(const desc::World& world, std::uint64_t seed)
    : physics(world.physics, world.gravity, seed), ambient_temperature(world.ambient_temperature) {
  ambience.ambient = world.scene.ambient.head<3>().cwiseMax(kNight);
  ambience.background = world.scene.background.head<3>();
}

Parts Engines::add(const desc::Model& model) {
  Parts parts;
  parts.body = physics.add(model);
  parts.is_static = model.is_static;
  parts.walks = !model.links.empty() && model.links.front().upright;
  parts.links = physics.links(parts.body);
  parts.joints = physics.joints(parts.body);
  const auto anchored = links_joined_to_world(model);
  parts.child_joints = joints_by_child(model);
  note_change();
  int first_visual = 0;
  for (std::uint32_t i = 0; i < model.links.size(); ++i) {
    const desc::Link& link = model.links[i];
    const Pose pose = physics.pose(parts.links[i]);
    parts.first_shape.push_back(static_cast<std::uint32_t>(parts.shapes.size()));
    const bool held = model.is_static || anchored.count(link.name) != 0;
    const auto mobility = model.is_static ? rays::Mobility::kStatic : rays::Mobility::kAnchored;
    parts.loose.push_back(held ? Resting::kNone : loose.add(pose));
    for (const desc::Collision& collision : link.collisions) {
      const int like = like_visual(link, collision);
      const desc::Visual visual = like < 0 ? desc::Visual{} : link.visuals[like];
      const rays::ShapeId shape = rays.add(collision.shape, pose * collision.pose, mobility,
                                           visual.material.diffuse.head<3>());
      if (visual.temperature) rays.warm(shape, *visual.temperature);
      parts.shapes.push_back({shape, i, collision.pose, like < 0 ? -1 : first_visual + like});
      if (!held) loose.add_shape(parts.loose.back(), shape);
      show(parts, parts.shapes.back());
    }
    first_visual += static_cast<int>(link.visuals.size());
    parts.bodies.push_back(visuals.add(visible(link, pose, !model.is_static)));
    if (link.upright && i == 0) add_limbs(link, parts.links[i], pose);
    for (const desc::Light& light : link.lights) {
      Parts::Lamp lamp = add_light(light, pose * light.pose);
      lamp.link = i;
      lamp.offset = light.pose;
      parts.lamps.push_back(lamp);
    }
  }
  parts.first_shape.push_back(static_cast<std::uint32_t>(parts.shapes.size()));
  return parts;
}

void Engines::add_limbs(const desc::Link& link, physics::LinkId id, const Pose& pose) {
  Walker& walker = walkers_[id.index];
  walker = {};
  for (int limb = 0; limb < kLimbs; ++limb) {
    walker.limbs.push_back(visuals.add(visible(link, pose, true, limb)));
  }
}

void Engines::place_limbs() {
  for (auto& [link, walker] : walkers_) {
    if (std::exchange(walker.placed, true)) continue;
    for (int limb = 0; limb < kLimbs; ++limb) {
      visuals.move(walker.limbs[static_cast<std::size_t>(limb)],
                   walker.pose * walker.gait.limb(limb));
    }
  }
}

void Engines::remove(const Parts& parts) {
  note_change();
  for (const Resting::Body body : parts.loose) {
    if (body != Resting::kNone) loose.remove(body);
  }
  for (const Parts::Shape& shape : parts.shapes) {
    note_standing(parts, shape);
    if (parts.is_static) {
      movers.change_static(rays.bounds(shape.id));
    } else {
      movers.remove(shape.id);
    }
    surfaces.remove(shape.id);
    rays.remove(shape.id);
  }
  for (const render::BodyId body : parts.bodies) visuals.remove(body);
  if (parts.walks) {
    const auto walker = walkers_.find(parts.links.front().index);
    for (const render::BodyId limb : walker->second.limbs) visuals.remove(limb);
    walkers_.erase(walker);
  }
  for (const Parts::Lamp& lamp : parts.lamps) light.remove(lamp.id);
  physics.remove(parts.body);
}

Parts::Lamp Engines::add_light(const desc::Light& described, const Pose& pose) {
  light::Lamp lamp;
  lamp.pose = pose;
  lamp.direction = described.direction;
  lamp.color = with_luminance_one(described.diffuse);
  lamp.inner_angle = described.inner_angle;
  lamp.outer_angle = described.outer_angle;
  lamp.cast_shadows = described.cast_shadows;
  lamp.luminous_flux = desc::brightness(described);
  if (described.type == desc::Light::Type::kSpot) lamp.type = light::Lamp::Type::kSpot;
  if (described.type == desc::Light::Type::kDirectional) {
    lamp.type = light::Lamp::Type::kDirectional;
  }
  if (described.type == desc::Light::Type::kRectangle) {
    lamp.type = light::Lamp::Type::kRectangle;
    lamp.width = described.width;
    lamp.height = described.height;
  }
  if (described.type == desc::Light::Type::kDisc) lamp.type = light::Lamp::Type::kDisc;
  if (described.type == desc::Light::Type::kTube) {
    lamp.type = light::Lamp::Type::kTube;
    lamp.length = described.length;
  }
  if (described.radius > 0.0) lamp.radius = described.radius;
  lamp.half_angle = described.half_angle;
  lamp.photometry = described.photometry;
  if (lamp.photometry) lamp.photometric_flux = light::flux(*lamp.photometry);
  Parts::Lamp part;
  part.level = desc::shines(described) ? 1.0 : 0.0;
  part.id = light.add(lamp, part.level);
  part.nominal_flux = lamp.luminous_flux;
  return part;
}

void Engines::note_standing(const Parts& parts, const Parts::Shape& shape) {
  const bool standing = rays.mobility(shape.id.index) != rays::Mobility::kMoving;
  if (parts.is_static || standing) standing_changed_ = movers.now();
}

void Engines::show(const Parts& parts, const Parts::Shape& shape) {
  note_standing(parts, shape);
  if (parts.is_static) {
    movers.change_static(rays.bounds(shape.id));
  } else {
    movers.put(shape.id, rays.bounds(shape.id));
  }
}

void Engines::set_standing(Resting::Body body, bool standing) {
  note_change();
  standing_changed_ = movers.now();
  for (const rays::ShapeId shape : loose.shapes(body)) {
    rays.set_anchored(shape, standing);
    movers.put(shape, rays.bounds(shape));
  }
}

void Engines::note_rest(Nanoseconds now) {
  loose.update(now, [&](Resting::Body body) { set_standing(body, true); });
}

void Engines::advance_light(Nanoseconds now) {
  light.begin_tick();
  if (!light_busy()) return;
  light_followed_ = movers.now() + 1;
  rays.commit();
  light.advance(now);
}

void Engines::follow(const Parts& parts, std::uint32_t link) {
  const Pose pose = physics.pose(parts.links[link]);
  const Resting::Body body = parts.loose[link];
  visuals.move(parts.bodies[link], pose);
  if (parts.walks && link == 0) {
    Walker& walker = walkers_[parts.links[link].index];
    walker.gait.advance(pose, physics.link(parts.links[link]).linear_velocity.head<2>().norm());
    walker.pose = pose;
    walker.placed = false;
  }
  if (body != Resting::kNone) {
    if (loose.move(body, pose)) set_standing(body, false);
    if (loose.rests(body)) return;  // it trembles by less than matters
  }
  for (std::uint32_t i = parts.first_shape[link]; i < parts.first_shape[link + 1]; ++i) {
    const Parts::Shape& shape = parts.shapes[i];
    if (parts.is_static) movers.change_static(rays.bounds(shape.id));
    rays.move(shape.id, pose * shape.offset);
    show(parts, shape);
  }
  for (const Parts::Lamp& lamp : parts.lamps) {
    if (lamp.link == link) light.move(lamp.id, pose * lamp.offset);
  }
}

}  // namespace angen::sim
