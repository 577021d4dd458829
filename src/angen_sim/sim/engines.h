#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "core/named.h"
#include "desc/world.h"
#include "light/lighting.h"
#include "physics/world.h"
#include "rays/scene.h"
#include "render/scene.h"
#include "sim/mover_index.h"
#include "sim/resting.h"
#include "sim/state_changes.h"
#include "sim/surface_temperatures.h"

namespace angen::sim {

/// A model's part in each engine.
struct Parts {
  struct Shape {
    rays::ShapeId id;
    std::uint32_t link = 0;
    Pose offset;       // in the link's frame
    int surface = -1;  // SurfaceRef of the visual that it is like, -1: none
    int posture = -1;  // in Anatomy::postures; -1: of all
    physics::CollisionId collision;
  };
  struct Lamp {
    light::LampId id;
    std::uint32_t link = 0;
    Pose offset;
    double nominal_flux = 0.0;  // lm at level 1 in the light engine
    double level = 0.0;         // what the device set, 0..1
  };
  physics::ModelId body;
  bool is_static = false;
  std::vector<physics::LinkId> links;                    // indexed like desc::Model::links
  std::vector<physics::JointId> joints;                  // indexed like desc::Model::joints
  std::vector<Shape> shapes;                             // in the order of links
  std::vector<std::uint32_t> first_shape;                // each link's first, and the number of all
  std::vector<std::vector<std::uint32_t>> child_joints;  // joints that each link is the child of
  std::vector<Resting::Body> loose;                      // each link's; kNone for one that is held
  std::vector<render::BodyId> bodies;                    // each link's body that cameras see
  std::vector<Lamp> lamps;                               // in the order of links and their lights
};

/// The engines, kept in step: a body's shapes and lamps follow it.
class Engines {
 public:
  Engines(const desc::World& world, std::uint64_t seed);

  Parts add(const desc::Model& model);  // throws Error and adds nothing
  void remove(const Parts& parts);
  Parts::Lamp add_light(const desc::Light& light, const Pose& pose);

  /// Shapes and lamps of `link` follow its body.
  void follow(const Parts& parts, std::uint32_t link);

  /// To be called once a tick, when all motion has been followed: bodies that came to rest become
  /// standing shapes.
  void note_rest(Nanoseconds now);
  /// When something will have come to rest, at the earliest.
  Nanoseconds next_rest() const { return loose.next(); }

  /// A link at rest at `pose`, with the shapes of one of its postures.
  void take_posture(const Parts& parts, std::uint32_t link, int posture, const Pose& pose);

  /// To be called once a tick: takes the standing shapes and lit lamps over, if it is time.
  void advance_light(Nanoseconds now);
  /// When advance_light() has something to do, at the earliest.
  Nanoseconds next_light() const;
  /// To be called after ticks that follow a clock: see light::Lighting::look_ahead().
  void look_ahead(Nanoseconds now);
  /// Where the limbs of a link are in its frame from now on.
  void place_limbs(physics::LinkId link, std::shared_ptr<const std::vector<Pose>> limbs);
  /// To be called before an image: limbs follow their links.
  void follow_limbs();

  physics::World physics;
  rays::Scene rays;
  render::Scene visuals;
  render::Ambience ambience;
  double ambient_temperature;  // K
  light::Lighting light{rays};
  MoverIndex movers;  // finds movers near sensors' rays
  SurfaceTemperatures surfaces{rays};
  Resting loose;
  StateChanges states;

  /// Something that sensors may query besides rays has changed: a pose, a light, a contact.
  void note_change() { changed_ = movers.now(); }
  MoverIndex::Moment changed() const { return changed_; }  // when last
  /// The last change of standing shapes: static, anchored, such as doors, or resting.
  MoverIndex::Moment standing_changed() const { return standing_changed_; }

 private:
  /// The limbs of a link, which cameras see move.
  struct Limbs {
    std::vector<render::BodyId> bodies;              // indexed like Anatomy::limbs
    std::shared_ptr<const std::vector<Pose>> poses;  // in the link's frame; null: at its origin
    Pose link;
    bool placed = true;
  };

  void add_limbs(const desc::Link& link, physics::LinkId id, const Pose& pose);
  void show(const Parts& parts, const Parts::Shape& shape);
  void note_standing(const Parts& parts, const Parts::Shape& shape);
  void set_standing(Resting::Body body, bool standing);

  std::unordered_map<std::uint32_t, Limbs> limbs_;  // by LinkId
  MoverIndex::Moment changed_ = 0;
  MoverIndex::Moment standing_changed_ = 0;
  MoverIndex::Moment light_followed_ = 0;  // advance_light() knows all changes before
};

/// The number of the link's visual that a collision has its surface from (albedo, temperature):
/// the visual of the same name, or its first; -1 if the link has none.
inline int like_visual(const desc::Link& link, const desc::Collision& collision) {
  if (const auto index = index_in(link.visuals, collision.name)) return static_cast<int>(*index);
  return link.visuals.empty() ? -1 : 0;
}

}  // namespace angen::sim
