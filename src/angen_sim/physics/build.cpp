#include "physics/build.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "core/diagnostics.h"
#include "core/union_find.h"
#include "physics/joints.h"
#include "physics/sleep.h"
#include "physics/wheel_line.h"

namespace angen::physics {

namespace {

using desc::Model;

constexpr double kNoLimit = 1e15;
constexpr std::ptrdiff_t kManyWheels = 4;  // whose loads statics alone does not give
constexpr double kWeight = 9.81;           // N/kg
constexpr double kWheelSinks = 1e-4;       // m, of what stands on one point

class Builder {
 public:
  Builder(const Model& model, ShapeFactory& shapes, std::uint64_t& serial)
      : model_(model), shapes_(shapes), serial_(serial), groups_(model.links.size() + 1) {}

  std::unique_ptr<ModelRecord> build() {
    record_ = std::make_unique<ModelRecord>();
    record_->name = model_.name;
    for (std::size_t i = 0; i < model_.links.size(); ++i) index_.emplace(model_.links[i].name, i);
    group_links();
    make_bodies();
    make_geoms();
    for (const desc::Joint& joint : model_.joints) make_joint(joint);
    mark_wheels(*record_);
    make_mechanisms();
    return std::move(record_);
  }

 private:
  // The world counts as one link more.
  std::size_t link_index(const std::string& name) const {
    return name == "world" ? model_.links.size() : index_.at(name);
  }

  // A body's frame has the axes of its first link, which is the root of its group.
  void group_links() {
    const std::size_t n = model_.links.size();
    for (const desc::Joint& joint : model_.joints) {
      if (joint.type != desc::Joint::Type::kFixed) continue;
      groups_.join(link_index(joint.parent), link_index(joint.child));
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (model_.is_static || model_.links[i].kinematic) groups_.join(i, n);
    }
  }

  void make_bodies() {
    const std::size_t n = model_.links.size();
    body_of_.assign(n + 1, nullptr);
    std::vector<Body*> of_root(n + 1, nullptr);
    for (std::size_t i = 0; i <= n; ++i) {
      Body*& body = of_root[groups_.root(i)];
      if (body == nullptr) {
        record_->bodies.push_back(std::make_unique<Body>());
        body = record_->bodies.back().get();
        body->model = record_.get();
        body->serial = serial_++;
        body->may_sleep = model_.allow_auto_disable;
      }
      body_of_[i] = body;
    }
    std::vector<std::vector<const desc::Link*>> members(n + 1);
    for (std::size_t i = 0; i < n; ++i) members[groups_.root(i)].push_back(&model_.links[i]);
    for (std::size_t i = 0; i <= n; ++i) {
      if (of_root[i] != nullptr) make_body(*of_root[i], groups_.root(i), members[groups_.root(i)]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const desc::Link& link = model_.links[i];
      Body& body = *body_of_[i];
      const double mass = body.dynamic() ? link.inertial.mass : 0.0;
      record_->links.push_back({&body, body.zero.inverse() * link.pose, mass});
    }
  }

  void make_body(Body& body, std::size_t root_index, const std::vector<const desc::Link*>& links) {
    const std::size_t n = model_.links.size();
    if (root_index < n) body.zero = model_.links[root_index].pose;
    if (groups_.root(n) == root_index) return;
    add_masses(body, links);
    for (const desc::Link* link : links) {
      body.upright = body.upright || link->anatomy.upright;
      body.side_stiffness = std::max(body.side_stiffness, link->anatomy.side_stiffness);
      if (link->gravity) continue;
      const Pose com = body.zero.inverse() * link->pose * link->inertial.pose;
      body.weightless.push_back({com.position, link->inertial.mass});
    }
    body.floats = body.weightless.size() == links.size();
    if (body.floats) body.weightless.clear();
  }

  // Sums mass, center and moment over the links, and puts the body's origin in the center.
  void add_masses(Body& body, const std::vector<const desc::Link*>& links) const {
    Vec3 center = Vec3::Zero();
    for (const desc::Link* link : links) {
      const double mass = link->inertial.mass;
      body.mass += mass;
      center += mass * (link->pose * link->inertial.pose).position;
    }
    body.zero.position = center / body.mass;
    for (const desc::Link* link : links) {
      const Pose com = body.zero.inverse() * link->pose * link->inertial.pose;
      const Eigen::Matrix3d turn = com.rotation.toRotationMatrix();
      const Vec3& d = com.position;
      body.moment += turn * link->inertial.moment * turn.transpose();
      body.moment +=
          link->inertial.mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
    }
    body.moment = 0.5 * (body.moment + body.moment.transpose()).eval();
    const bool good =
        body.moment.allFinite() &&
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.moment).eigenvalues().minCoeff() > 0.0;
    if (!good) {
      throw Error(links.front()->source, "link \"" + model_.name + "::" + links.front()->name +
                                             "\" has an inertia that no body can have, its " +
                                             "principal moments must be above 0");
    }
  }

  void make_geoms() {
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      const desc::Link& link = model_.links[i];
      const LinkRecord& at = record_->links[i];
      for (const desc::Collision& collision : link.collisions) {
        auto geom = shapes_.make(collision, model_.name + "::" + link.name + "::" + collision.name,
                                 at.body->dynamic());
        if (!geom) continue;
        geom->serial = serial_++;
        geom->body = at.body;
        geom->self_collides = link.self_collide.value_or(model_.self_collide);
        geom->in_body = at.in_body * collision.pose;
        if (at.body->dynamic()) geom->fastest = model_.customs.parting_speed;
        geom->touches = Anatomy::find(link.anatomy.postures, collision.name) <= 0;
        at.body->geoms.push_back(geom.get());
        record_->geoms.push_back(std::move(geom));
      }
    }
  }

  void make_joint(const desc::Joint& from) {
    auto joint = std::make_unique<Joint>();
    joint->name = from.name;
    joint->type = from.type;
    joint->anchor = from.anchor;
    joint->lead = from.lead;
    joint->longest_step = from.longest_step;
    Body* child = body_of_[link_index(from.child)];
    Body* parent = body_of_[link_index(from.parent)];
    const bool moves = child != parent && (child->dynamic() || parent->dynamic());
    if (moves) {
      joint->flipped = !child->dynamic();
      joint->first = joint->flipped ? parent : child;
      joint->second = joint->flipped ? child : parent;
      joint->first->joints.push_back(joint.get());
      joint->second->joints.push_back(joint.get());
    }
    for (const desc::JointAxis& axis : from.axes) {
      joint->axes.push_back(make_axis(axis, joint->flipped));
    }
    if (moves) measure_joint(*joint);
    record_->joints.push_back(std::move(joint));
  }

  void make_mechanisms() {
    for (const auto& body : record_->bodies) {
      if (!body->dynamic() || body->mechanism != nullptr) continue;
      record_->mechanisms.push_back(std::make_unique<Mechanism>());
      Mechanism& mechanism = *record_->mechanisms.back();
      take_in(*body, mechanism);
      std::sort(mechanism.bodies.begin(), mechanism.bodies.end(),
                [](const Body* a, const Body* b) { return a->serial < b->serial; });
    }
    for (const auto& mechanism : record_->mechanisms) {
      if (wheels_of(*mechanism) < kManyWheels) continue;
      mechanism->stiffness = mechanism->mass * kWeight / kWheelSinks;
    }
    for (const auto& joint : record_->joints) {
      if (joint->first != nullptr) joint->first->mechanism->joints.push_back(joint.get());
    }
  }

  static std::ptrdiff_t wheels_of(const Mechanism& mechanism) {
    std::ptrdiff_t count = 0;
    for (const Body* body : mechanism.bodies) {
      count += std::count_if(body->geoms.begin(), body->geoms.end(),
                             [](const Geom* geom) { return geom->is_wheel; });
    }
    return count;
  }

  static void take_in(Body& start, Mechanism& mechanism) {
    const auto take = [&](Body& body) {
      if (!body.dynamic() || body.mechanism != nullptr) return;
      body.mechanism = &mechanism;
      mechanism.bodies.push_back(&body);
      mechanism.mass += body.mass;
    };
    take(start);
    for (std::size_t i = 0; i < mechanism.bodies.size(); ++i) {
      for (const Joint* joint : mechanism.bodies[i]->joints) {
        take(*joint->first);
        take(*joint->second);
      }
    }
  }

  static Axis make_axis(const desc::JointAxis& from, bool flipped) {
    Axis axis;
    axis.in_model = (flipped ? -1.0 : 1.0) * from.xyz.normalized();
    axis.lower = from.lower < -kNoLimit ? -dInfinity : from.lower;
    axis.upper = from.upper > kNoLimit ? dInfinity : from.upper;
    axis.effort = from.effort;
    axis.velocity = from.velocity;
    axis.damping = from.damping;
    axis.friction = from.friction;
    axis.stiffness = from.spring_stiffness;
    axis.slack_at = from.spring_reference;
    axis.safety = from.safety;
    axis.initial = std::clamp(from.initial_position, axis.lower, axis.upper);
    return axis;
  }

  const Model& model_;
  ShapeFactory& shapes_;
  std::uint64_t& serial_;
  std::unique_ptr<ModelRecord> record_;
  std::unordered_map<std::string, std::size_t> index_;  // index of each link by name
  UnionFind groups_;                                    // links and, last, the world
  std::vector<Body*> body_of_;
};

// Displaces the child bodies of each joint by its initial position, from the roots outwards.
void displace(ModelRecord& record) {
  std::vector<std::pair<Body*, Pose>> queue;
  std::unordered_set<const Body*> seen;
  for (const auto& body : record.bodies) {
    const bool hangs = std::any_of(body->joints.begin(), body->joints.end(),
                                   [&](const Joint* joint) { return joint->first == body.get(); });
    if (!hangs) queue.emplace_back(body.get(), Pose{});
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto [body, moved] = queue[i];
    for (const Joint* joint : body->joints) {
      if (joint->second != body || joint->first == body) continue;
      if (!seen.insert(joint->first).second) continue;
      queue.emplace_back(joint->first, moved * joint_displacement(*joint));
    }
    if (!(moved == Pose{})) body->at = record.pose * moved * body->zero;
  }
}

}  // namespace

std::unique_ptr<ModelRecord> build_model(const Model& model, ShapeFactory& shapes,
                                         std::uint64_t& serial) {
  return Builder(model, shapes, serial).build();
}

void configure(dWorldID world, ModelRecord& record, const Pose& pose) {
  record.pose = pose;
  for (const auto& body : record.bodies) body->at = pose * body->zero;
  displace(record);
  for (const auto& mechanism : record.mechanisms) {
    take_out(*mechanism);
    mechanism->stopped = false;
    for (Body* body : mechanism->bodies) body->upright_at = body->at.rotation;
    insert(world, *mechanism);
    // ODE normalizes the quaternion once more.
    for (Body* body : mechanism->bodies) {
      body->at.rotation = ode::quat(dBodyGetQuaternion(body->ode.get()));
    }
  }
  for (const auto& geom : record.geoms) follow_body(*geom);
  for (const auto& joint : record.joints) reset_joint(*joint);
}

}  // namespace angen::physics
