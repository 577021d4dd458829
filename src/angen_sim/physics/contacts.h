#pragma once

#include <map>
#include <set>
#include <vector>

#include "core/contact.h"
#include "physics/contact_law.h"
#include "physics/model.h"
#include "physics/wheel_line.h"

namespace angen::physics {

/// True when two geoms are allowed to touch: not of one body, not both static, not joined, and of
/// one model only if both collide with their own.
bool may_touch(const Geom& a, const Geom& b);

/// Contacts: pairs of awake bodies, which each step computes again, and pairs that fell asleep.
class Contacts {
 public:
  struct Pair {
    Geom* first = nullptr;  // the smaller serial
    Geom* second = nullptr;
    std::size_t begin = 0;  // in points
    std::size_t count = 0;
  };

  static PairKey key_of(const Pair& pair) { return {pair.first->serial, pair.second->serial}; }

  Contacts(const desc::Physics& settings, const Vec3& gravity);

  void set(const desc::Physics& settings, const Vec3& gravity);

  /// s, of the steps from now on.
  void set_step(double step) { settings_.step = step; }

  /// Whether bodies on joints touched nothing in the last step, and upright bodies only static
  /// shapes below them, and other things if both have been idle for so many steps, and no motor
  /// moves them.
  bool allow_long_steps(int idle_steps) const;

  /// Forgets the pairs of the last step.
  void start();

  /// Sets the world of contact joints; it may change between finish() and make_joints().
  void use(dWorldID world);

  /// True if there are too many contact points, or meshes in each other take too long, and those of
  /// two moving bodies are skipped: bodies that were put in one place would take all memory and
  /// time.
  bool full() const;
  /// Whether contacts of this step were simplified for that reason.
  bool tangled() const { return tangled_; }

  /// Narrow phase; true when the geoms touch.
  bool collide(Geom& a, Geom& b);

  /// Sorts the pairs by serials and makes ODE's contact joints, in that order.
  void make_joints();

  /// Replaces the contact joints by those of the bodies marked `again`, with the push that
  /// separates overlapping bodies or without.
  void make_joints_again(bool push);

  /// After a step: whether friction was bounded by other normal forces than the step gave. Marks
  /// the bodies of such points `again`; their next joints have better bounds, `lower` ones if no
  /// others were found.
  bool revise_friction(bool lower);

  /// m/s, at which deep contacts separate.
  double fastest() const { return settings_.fastest; }

  /// Reads the forces of the step and takes the contact joints away.
  void finish();

  const std::vector<Pair>& active() const { return pairs_; }

  /// Records the contacts of watched geoms in the step of this tick.
  void remember(std::int64_t tick);
  /// `now`, and the contacts of the geom since tick `first`. Watches the geom from now on.
  static std::vector<ContactPair> with_recent(Geom& geom, std::int64_t first,
                                              std::vector<ContactPair> now);

  /// Keeps those pairs of the last step whose bodies are all asleep now.
  void put_to_rest();

  /// Drops the contacts that a body kept while it slept.
  void forget(Body& body);

  /// Drops every pair of a model, and calls wake(Body&) for the sleeping bodies that it touched.
  template <class F>
  void drop(const ModelRecord& model, F&& wake) {
    for (auto it = resting_.begin(); it != resting_.end();) {
      const Resting& pair = it->second;
      if (pair.first->body->model != &model && pair.second->body->model != &model) {
        ++it;
        continue;
      }
      for (Body* body : {pair.first->body, pair.second->body}) {
        if (body->model != &model) wake(*body);
      }
      note_change(*pair.first, *pair.second);
      with_smaller_.erase({it->first.second, it->first.first});
      it = resting_.erase(it);
    }
    drop_active(model);
  }

  /// All pairs, by serials.
  std::vector<ContactPair> list() const;
  /// Contacts of one geom, by the other's serial and turned so that it is the first.
  std::vector<ContactPair> of(const Geom& geom) const;

 private:
  /// Forces between two mechanisms, or one and the static world, in the last step.
  struct Load {
    Vec3 friction = Vec3::Zero();  // N, on the first mechanism
    double pressed = 0.0;          // N
  };

  /// What bounds the friction of a contact point: mu times a normal force, of which a step begins
  /// with a guess.
  struct Grip {
    Eigen::Vector2d mu = Eigen::Vector2d::Zero();     // along two directions
    bool cone = true;                                 // false: the pyramid that a file asks for
    Vec3 along = Vec3::UnitX();                       // the first direction
    Eigen::Vector2d share = Eigen::Vector2d::Ones();  // part of the bounds, along each direction
    double pressed = -1.0;   // N, the guess; below 0: none, ODE takes its own
    bool firm = false;       // far from slipping: ODE takes its own, too
    double error = 0.0;      // N, of the guess of the pass before
    double corrected = 0.7;  // share of it by which the guess was corrected

    /// N, least normal force that allows this friction (N, along both directions).
    double needed(const Eigen::Vector2d& friction) const;
    /// The next guess, after a step that gave this normal force (N); only falls if `lower`.
    void correct(double gave, bool lower);
  };

  struct Resting {
    Geom* first = nullptr;
    Geom* second = nullptr;
    std::vector<ContactPoint> points;
  };

  static void note_change(Geom& first, Geom& second) {
    ++first.contacts_revision;
    ++second.contacts_revision;
  }
  bool is_tangle(const Geom& a, const Geom& b);
  void drop_active(const ModelRecord& model);
  std::vector<ContactPoint> points_of(const Pair& pair) const;
  void sum_loads();
  void start_grips();
  const ContactPoint& nearest_before(const Pair& pair, const Vec3& at) const;
  bool revise(std::size_t index, bool lower);
  void make_joints_of(const Pair& pair, bool push);
  void attach(dContact& contact, const Pair& pair, std::size_t index);
  void set_friction(dContact& contact, const Pair& pair, std::size_t index);
  void align(dContact& contact, const Pair& pair) const;
  void read_forces(const Pair& pair);

  dWorldID world_ = nullptr;
  ContactSettings settings_;
  ode::JointGroupHandle group_;
  std::size_t most_joints_ = 0;  // most joints that group_ has held
  std::size_t in_meshes_ = 0;    // tests of meshes against each other in this step
  bool tangled_ = false;
  std::vector<Pair> pairs_;
  std::vector<dContactGeom> found_;
  std::vector<PointShare> shares_;  // indexed like found_
  std::vector<Grip> grips_;         // indexed like found_
  std::vector<ContactPoint> points_;
  std::map<std::pair<const Mechanism*, const Mechanism*>, Load> loads_;
  std::vector<Pair> pairs_before_;  // pairs of the step before this one
  std::vector<ContactPoint> points_before_;
  std::vector<dJointFeedback> feedback_;
  std::map<PairKey, Resting> resting_;
  std::set<PairKey> with_smaller_;  // the keys of resting_, turned
};

}  // namespace angen::physics
