#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "desc/world.h"
#include "physics/height_tiles.h"
#include "physics/mesh_boxes.h"
#include "physics/ode.h"
#include "physics/world.h"

/// A model in physics: bodies (links fixed to each other), their geoms, and the joints between
/// them.
namespace angen::physics {

struct Body;
struct ModelRecord;

/// Two geoms by their serials, the smaller first.
using PairKey = std::pair<std::uint64_t, std::uint64_t>;

/// An axis-aligned box in the world, meters.
struct Aabb {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();

  bool overlaps(const Aabb& o) const {
    return min.x() <= o.max.x() && o.min.x() <= max.x() && min.y() <= o.max.y() &&
           o.min.y() <= max.y() && min.z() <= o.max.z() && o.min.z() <= max.z();
  }
};

/// Triangles as ODE wants them; keeps the vertices alive that ODE points to.
struct MeshData {
  std::shared_ptr<const TriangleMesh> mesh;
  Eigen::Matrix3Xd corners;  // m, of its triangles, each once; none if nothing of it moves
  ode::MeshHandle data;
  mutable std::optional<MeshBoxes> boxes;  // once it has collided with another mesh
};

struct alignas(64) Geom {
  Aabb box;  // first, with `visited`: the grid looks at these of many
  std::uint64_t visited = 0;
  std::string name;  // model::link::collision
  CollisionId id;
  std::uint64_t serial = 0;
  Body* body = nullptr;
  Pose in_body;
  desc::Friction friction;
  double restitution = 0.0;
  std::optional<double> stiffness;
  std::optional<double> damping;
  std::optional<double> min_depth;
  double thickness = std::numeric_limits<double>::infinity();  // m, of a box
  double fastest = std::numeric_limits<double>::infinity();    // m/s, at which contacts push it out
  std::shared_ptr<const MeshData> mesh;
  std::shared_ptr<HeightTiles> tiles;  // a heightmap's
  ode::GeomHandle ode;                 // a heightmap's is the box around it
  ode::GeomHandle tile;                // takes the mesh of one tile after the other
  bool is_plane = false;
  bool is_wheel = false;                                // a cylinder that turns about its own axis
  std::array<int, 6> cells{};                           // the grid's, first and last in x, y, z
  std::vector<const std::vector<Geom*>*> shared_cells;  // the geoms in each of them, for queries
  bool in_grid = false;
  bool touches = true;  // false: of another posture than the present one
  bool unbounded = false;
  std::uint64_t contacts_revision = 0;  // grows when its contacts change
  bool self_collides = false;           // it touches others of its model that do so too
  bool watched = false;                 // `recent` is kept
  struct Recent {
    std::int64_t tick = 0;
    ContactPair pair;
  };
  std::map<std::uint64_t, Recent> recent;  // by the other's serial, with the tick when it touched
};

/// One degree of freedom of a joint.
struct Axis {
  Vec3 in_model = Vec3::UnitZ();  // with all joints at 0, already turned for `flipped`
  double lower = -dInfinity;
  double upper = dInfinity;
  double effort = -1.0;
  double velocity = -1.0;
  double damping = 0.0;
  double friction = 0.0;
  double stiffness = 0.0;  // its spring's
  double slack_at = 0.0;   // its rest position
  double initial = 0.0;
  std::optional<desc::JointSafety> safety;
};

/// A joint between `first` (always dynamic) and `second`. When the description's child is static
/// the two change places and the axes are negated: positions, speeds and efforts keep their signs.
struct Joint {
  std::string name;
  desc::Joint::Type type = desc::Joint::Type::kFixed;
  Body* first = nullptr;  // null when nothing can move: a fixed joint, or two static bodies
  Body* second = nullptr;
  bool flipped = false;
  Vec3 anchor = Vec3::Zero();  // in the model's frame, all joints at 0
  std::vector<Axis> axes;
  double lead = 0.0;          // m/rad, of a screw
  double longest_step = 0.0;  // s, of what leads it
  ode::JointHandle main;      // the constraint with its stops; null as its bodies'
  ode::JointHandle motor;     // first row: motor, brake or dry friction; second row: damping
  ode::JointHandle thread;    // a screw's, couples its way and its angle
  dJointFeedback main_feedback{};
  dJointFeedback motor_feedback{};
  dJointFeedback thread_feedback{};
  Vec3 axis_in_body = Vec3::UnitZ();  // the first body's; a universal joint's parent's
  Vec3 anchor_in_first = Vec3::Zero();
  double motor_velocity = 0.0;
  double motor_force = 0.0;
  bool latched = false;
  bool latch_broken = false;   // until the force that broke it has ended
  double latch_force = 0.0;    // N m or N, infinite: nothing breaks it
  double latch_strain = 0.0;   // N m or N, that it bears, averaged over some time
  double latch_at = 0.0;       // rad or m, as ODE measures it
  double inertia = 0.0;        // least that moves about or along the first axis, kg m^2 or kg
  double spring_effort = 0.0;  // in the last step, where no row of `motor` gave it
  double pushes = 0.0;         // force added for the next step
  double pushed = 0.0;         // force added for the last one
  double raw_angle = 0.0;      // in [-pi, pi]
  int turns = 0;
  double position = 0.0;
  double effort = 0.0;
};

/// A motor on one body in the horizontal plane.
struct Drive {
  ode::JointHandle linear;  // null as their body's
  ode::JointHandle angular;
  Vec3 velocity = Vec3::Zero();
  double yaw_rate = 0.0;
  double max_force = 0.0;
  dJointFeedback feedback{};  // feedback of `linear`, in the last step
};

/// Part of a body that gravity leaves alone.
struct Weightless {
  Vec3 center = Vec3::Zero();  // in the body's frame
  double mass = 0.0;
};

/// Torques on a body that spins.
struct Gyroscopic {
  bool acts = false;             // in this step, instead of ODE's own
  Vec3 spin = Vec3::Zero();      // rad/s, before the step
  Vec3 torque = Vec3::Zero();    // N m, the gyroscopic one
  Vec3 others = Vec3::Zero();    // N m, all else in the last step
  Vec3 expected = Vec3::Zero();  // N m, of these in the next step
};

/// Dynamic bodies that joints hold together, or one alone: they wake and sleep as one.
struct Mechanism {
  std::vector<Body*> bodies;   // by serial
  std::vector<Joint*> joints;  // also those to static bodies
  double mass = 0.0;           // kg, of all its bodies
  double stiffness = 0.0;      // N/m, of a contact point, if it has many wheels; 0: rigid
  bool stopped = false;        // went beyond the limits: asleep until it is placed again

  /// Whether joints connect it to something static.
  bool anchored() const;
};

/// Passes that look for the bounds of friction (step.cpp), which an island may save up.
constexpr int kSavedPasses = 2000;

/// One or more links that are fixed to each other. Its frame has the axes of its first link and its
/// origin in the common center of mass.
struct Body {
  ModelRecord* model = nullptr;
  std::uint64_t serial = 0;
  Mechanism* mechanism = nullptr;  // null: static
  ode::BodyHandle ode;             // null: static, or asleep
  Pose zero;                       // in the model's frame, all joints at 0
  Pose at;                         // in the world
  double mass = 0.0;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  // about the center of mass, in its own axes
  bool floats = false;                               // gravity leaves all of it alone
  bool upright = false;
  double side_stiffness = 0.0;         // N/m, see Anatomy
  Quat upright_at = Quat::Identity();  // the rotation that yaw is counted from
  bool may_sleep = true;
  bool awake = false;
  int idle_steps = 0;
  Pose idle_at;                  // where its idle time began
  std::uint64_t collided = 0;    // the last step in which its pairs were tested
  std::uint32_t island = 0;      // scratch
  bool iterated = false;         // in a large island: the last step was by dWorldQuickStep
  double overlap = 0.0;          // m, of its deepest rigid contact, beyond the layer
  bool overlaps = false;         // since it was deep in something, until it is out
  int parting_steps = 0;         // steps left since its island had such a body
  bool parts = false;            // its island has a body with such steps
  bool again = false;            // scratch: its step is taken again
  int passes = kSavedPasses;     // left to its island; below 0: steps without any
  double pushed = 0.0;           // m/s, of its points, out of overlaps in the last step
  std::vector<PairKey> resting;  // contacts kept since it fell asleep
  Gyroscopic gyroscopic;
  std::vector<LinkId> links;
  std::vector<Geom*> geoms;
  std::vector<Joint*> joints;
  std::vector<Weightless> weightless;
  std::optional<Drive> drive;

  bool dynamic() const { return mass > 0.0; }
  Vec3 velocity() const { return ode ? ode::vec(dBodyGetLinearVel(ode.get())) : Vec3::Zero(); }
  Vec3 spin() const { return ode ? ode::vec(dBodyGetAngularVel(ode.get())) : Vec3::Zero(); }
  Vec3 velocity_at(const Vec3& point) const {
    return ode ? Vec3(velocity() + spin().cross(point - at.position)) : Vec3::Zero();
  }
  double inverse_mass() const { return dynamic() ? 1.0 / mechanism->mass : 0.0; }
};

inline bool Mechanism::anchored() const {
  return std::any_of(joints.begin(), joints.end(),
                     [](const Joint* joint) { return !joint->second->dynamic(); });
}

struct LinkRecord {
  Body* body = nullptr;
  Pose in_body;
  double mass = 0.0;
};

struct ModelRecord {
  std::string name;
  Pose pose;
  std::vector<LinkId> link_ids;
  std::vector<JointId> joint_ids;
  std::vector<LinkRecord> links;              // indexed like the description, until ids are given
  std::vector<std::unique_ptr<Body>> bodies;  // destroyed after joints and geoms
  std::vector<std::unique_ptr<Mechanism>> mechanisms;
  std::vector<std::unique_ptr<Geom>> geoms;
  std::vector<std::unique_ptr<Joint>> joints;  // indexed like the description
};

}  // namespace angen::physics
