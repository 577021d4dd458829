#include <cmath>
#include <map>

#include "core/random.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "import/gazebo.h"

namespace angen::load {

namespace {

constexpr int kMaxClones = 10'000;
constexpr double kRoadHeight = 0.01;  // m

int count_of(const Element& parent, const std::string& name, int fallback) {
  const Element* child = parent.child(name);
  if (child == nullptr) return fallback;
  const double value = number_of(*child);
  if (value < 1.0 || value > kMaxClones || value != std::floor(value)) {
    throw Error(child->source, "<" + name + "> is " + number_text(value) +
                                   "; give a whole number from 1 to " + std::to_string(kMaxClones));
  }
  return static_cast<int>(value);
}

Vec3 vector_in(const Element* parent, const char* name, const Vec3& fallback) {
  const Element* child = parent == nullptr ? nullptr : parent->child(name);
  if (child == nullptr) return fallback;
  const std::vector<double> v = numbers_of(*child, 3);
  return {v[0], v[1], v[2]};
}

/// The region that a population fills, around its pose.
struct Region {
  Vec3 size = Vec3::Ones();  // m, of a box
  double radius = 0.0;       // m, of a cylinder; 0 = a box
  double length = 0.0;

  // The place of three numbers from 0 to 1.
  Vec3 at(const Vec3& share) const {
    if (radius <= 0.0) return size.cwiseProduct(share - Vec3::Constant(0.5));
    const double out = radius * std::sqrt(share.x());
    const double turn = 2.0 * M_PI * share.y();
    return {out * std::cos(turn), out * std::sin(turn), length * (share.z() - 0.5)};
  }
};

Region region_of(const Element& population) {
  Region region;
  region.size = vector_in(population.child("box"), "size", region.size);
  if (const Element* cylinder = population.child("cylinder")) {
    region.radius = child_number(*cylinder, "radius", 1.0);
    region.length = child_number(*cylinder, "length", 1.0);
  }
  return region;
}

// Evenly strewn: the additive sequence of the plastic number's powers, Roberts 2018.
Vec3 evenly(int index) {
  constexpr double kPlastic = 1.2207440846057596;
  const auto share = [&](int power) {
    return std::fmod(0.5 + (index + 1) * std::pow(kPlastic, -power), 1.0);
  };
  return {share(1), share(2), share(3)};
}

std::vector<Vec3> grid(const Element& distribution) {
  const int rows = count_of(distribution, "rows", 1);
  const int columns = count_of(distribution, "cols", 1);
  if (rows * columns > kMaxClones) {
    throw Error(distribution.source, "a grid of more than " + std::to_string(kMaxClones) +
                                         " models; give fewer <rows> or <cols>");
  }
  const Vec3 step = vector_in(&distribution, "step", Vec3(0.5, 0.5, 0.0));
  std::vector<Vec3> places;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      places.emplace_back(step.x() * (column - (columns - 1) / 2.0),
                          step.y() * (row - (rows - 1) / 2.0), 0.0);
    }
  }
  return places;
}

std::vector<Vec3> places_of(const Element& population) {
  const Element* distribution = population.child("distribution");
  const std::string type =
      distribution == nullptr ? "random" : distribution->child_text("type", "random");
  if (distribution != nullptr && type == "grid") return grid(*distribution);
  static const std::map<std::string, int> lines = {
      {"linear-x", 0}, {"linear-y", 1}, {"linear-z", 2}};
  const auto line = lines.find(type);
  if (line == lines.end() && type != "random" && type != "uniform") {
    throw Error(distribution->source, "unknown <distribution> '" + printable(type) +
                                          "'; known are random, uniform, grid, linear-x, "
                                          "linear-y, linear-z");
  }
  const int count = count_of(population, "model_count", 1);
  const Region region = region_of(population);
  Rng rng(0, hash_bytes(name_of(population)), 0);
  std::vector<Vec3> places;
  for (int i = 0; i < count; ++i) {
    Vec3 share = type == "uniform" ? evenly(i) : Vec3(rng.uniform(), rng.uniform(), rng.uniform());
    if (line != lines.end()) {
      share = Vec3::Constant(0.5);
      share[line->second] = (i + 0.5) / count;
    }
    places.push_back(line == lines.end() ? region.at(share)
                                         : region.size.cwiseProduct(share - Vec3::Constant(0.5)));
  }
  return places;
}

// Copies of its <model>, called NAME_clone_0, NAME_clone_1, …: on a grid, in a row, or strewn over
// a box or a cylinder, always in the same places.
std::vector<Element> population_models(const Element& population) {
  const Element* model = population.child("model");
  if (model == nullptr) {
    throw Error(population.source, tag_of(population) + " has no <model>; give it one");
  }
  const Pose around = child_pose(population);
  const Pose own = child_pose(*model);
  std::vector<Element> models;
  for (const Vec3& place : places_of(population)) {
    Element clone = *model;
    set_attribute(clone, "name", name_of(*model) + "_clone_" + std::to_string(models.size()));
    set_child(clone, "pose", pose_text(around * Pose{place, Quat::Identity()} * own));
    models.push_back(std::move(clone));
  }
  return models;
}

// A static model of flat boxes from one point of the road to the next; nothing collides with it.
Element road_model(const Element& road) {
  const double width = child_number(road, "width", 1.0);
  std::vector<Vec3> points;
  for (const Element& child : road.children) {
    if (child.name != "point") continue;
    const std::vector<double> v = numbers_of(child, 3);
    points.emplace_back(v[0], v[1], v[2]);
  }
  if (points.size() < 2) {
    throw Error(road.source, tag_of(road) + " has " + std::to_string(points.size()) +
                                 " <point>s; give it two or more");
  }
  Element link{"link", "", {}, {}, road.source};
  set_attribute(link, "name", "link");
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 along = points[i + 1] - points[i];
    if (along.norm() < 1e-9) continue;
    Pose pose{(points[i] + points[i + 1]) / 2.0,
              from_rpy(0.0, -std::asin(along.normalized().z()), std::atan2(along.y(), along.x()))};
    pose.position.z() -= kRoadHeight / 2.0 - 1e-3;  // its top is a little above the ground
    Element visual{"visual", "", {}, {}, road.source};
    set_attribute(visual, "name", "part_" + std::to_string(i));
    const std::string size =
        number_text(along.norm()) + " " + number_text(width) + " " + number_text(kRoadHeight);
    visual.children = {
        Element{"pose", pose_text(pose), {}, {}, road.source},
        Element{"geometry",
                "",
                {},
                {Element{"box", "", {}, {Element{"size", size, {}, {}, road.source}}, road.source}},
                road.source},
        Element{"material",
                "",
                {},
                {Element{"diffuse", "0.3 0.3 0.3 1", {}, {}, road.source}},
                road.source}};
    link.children.push_back(std::move(visual));
  }
  Element model{
      "model", "", {}, {Element{"static", "true", {}, {}, road.source}, link}, road.source};
  set_attribute(model, "name", name_of(road));
  return model;
}

}  // namespace

std::vector<Element> Gazebo::models_of(const Element& part) const {
  return part.name == "road" ? std::vector<Element>{road_model(part)} : population_models(part);
}

}  // namespace angen::load
