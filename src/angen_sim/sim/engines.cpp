#include "sim/engines.h"

#include <set>
#include <string>
#include <utility>

#include "desc/own_lamp.h"
#include "light/photometry.h"
#include "plugin/plugin.h"
#include "sim/joined.h"

namespace angen::sim {

namespace {

constexpr Nanoseconds kSettled = 6 * kSecond;  // loose objects of the world have come to rest
constexpr float kNight = 0.1F;  // least of SDF's ambient: the light of a dark world for cameras

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

// Glass and the like, which lets more than half of the light through, is not seen. Limbs are
// bodies of their own; limb -1 is the rest of the link.
render::Body visible(const desc::Link& link, const Pose& pose, bool moves, int limb = -1) {
  render::Body body;
  body.pose = pose;
  body.moves = moves;
  body.holds_lamp = !link.lights.empty();
  for (const desc::Visual& visual : link.visuals) {
    const desc::Material& material = visual.material;
    if (material.diffuse.w() < 0.5F) continue;
    if (Anatomy::find(link.anatomy.limbs, visual.name) != limb) continue;
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
      if (visual.temperature) rays.warm(shape, Warming::constant(*visual.temperature));
      const int posture = Anatomy::find(link.anatomy.postures, collision.name);
      const std::string name = model.name + "::" + link.name + "::" + collision.name;
      parts.shapes.push_back({shape, i, collision.pose, like < 0 ? -1 : first_visual + like,
                              posture, physics.collision(name)});
      rays.show(shape, posture <= 0);
      if (!held) loose.add_shape(parts.loose.back(), shape);
      show(parts, parts.shapes.back());
    }
    first_visual += static_cast<int>(link.visuals.size());
    parts.bodies.push_back(visuals.add(visible(link, pose, !model.is_static)));
    add_limbs(link, parts.links[i], pose);
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
  const auto count = static_cast<int>(link.anatomy.limbs.size());
  for (int limb = 0; limb < count; ++limb) {
    limbs_[id.index].bodies.push_back(visuals.add(visible(link, pose, true, limb)));
    limbs_[id.index].link = pose;
  }
}

void Engines::place_limbs(physics::LinkId link, std::shared_ptr<const std::vector<Pose>> limbs) {
  Limbs& placed = limbs_.at(link.index);
  placed.poses = std::move(limbs);
  placed.placed = false;
}

void Engines::follow_limbs() {
  for (auto& [link, limbs] : limbs_) {
    if (std::exchange(limbs.placed, true)) continue;
    const Pose& pose = limbs.link;
    for (std::size_t i = 0; i < limbs.bodies.size(); ++i) {
      visuals.move(limbs.bodies[i], limbs.poses ? pose * limbs.poses->at(i) : pose);
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
  for (const physics::LinkId link : parts.links) {
    const auto limbs = limbs_.find(link.index);
    if (limbs == limbs_.end()) continue;
    for (const render::BodyId limb : limbs->second.bodies) visuals.remove(limb);
    limbs_.erase(limbs);
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

void Engines::take_posture(const Parts& parts, std::uint32_t link, int posture, const Pose& pose) {
  physics.move(parts.links[link], pose * physics.pose(parts.links[link]).inverse());
  note_change();
  for (std::uint32_t i = parts.first_shape[link]; i < parts.first_shape[link + 1]; ++i) {
    const Parts::Shape& shape = parts.shapes[i];
    if (shape.posture < 0) continue;
    const bool counts = shape.posture == posture;
    rays.show(shape.id, counts);
    if (shape.collision.valid()) physics.set_touches(shape.collision, counts);
    show(parts, shape);
  }
  follow(parts, link);
}

void Engines::note_rest(Nanoseconds now) {
  loose.update(now, [&](Resting::Body body) { set_standing(body, true); });
}

Nanoseconds Engines::next_light() const {
  if (!light.keeps_time()) return kForever;
  if (!light.dark() && standing_changed_ >= light_followed_) return 0;
  return light.next().value_or(kForever);
}

void Engines::advance_light(Nanoseconds now) {
  if (next_light() > now) return;
  light_followed_ = movers.now() + 1;
  rays.commit();
  light.advance(now);
}

void Engines::look_ahead(Nanoseconds now) {
  if (now < kSettled || !light.may_look_ahead()) return;
  rays.commit();
  light.look_ahead();
}

void Engines::follow(const Parts& parts, std::uint32_t link) {
  const Pose pose = physics.pose(parts.links[link]);
  const Resting::Body body = parts.loose[link];
  visuals.move(parts.bodies[link], pose);
  if (!limbs_.empty()) {
    const auto limbs = limbs_.find(parts.links[link].index);
    if (limbs != limbs_.end()) {
      limbs->second.link = pose;
      limbs->second.placed = false;
    }
  }
  if (body != Resting::kNone) {
    if (loose.move(body, pose)) set_standing(body, false);
    if (loose.rests(body)) return;  // it trembles by less than matters
  }
  for (std::uint32_t i = parts.first_shape[link]; i < parts.first_shape[link + 1]; ++i) {
    const Parts::Shape& shape = parts.shapes[i];
    if (rays.is_hidden(shape.id)) continue;
    if (parts.is_static) movers.change_static(rays.bounds(shape.id));
    rays.move(shape.id, pose * shape.offset);
    show(parts, shape);
  }
  for (const Parts::Lamp& lamp : parts.lamps) {
    if (lamp.link == link) light.move(lamp.id, pose * lamp.offset);
  }
}

}  // namespace angen::sim
