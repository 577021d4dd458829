#include "sdf/reader.h"

#include <algorithm>
#include <cmath>

#include "core/lists.h"
#include "core/text.h"
#include "document/dialect.h"
#include "document/values.h"

namespace angen::load {

namespace {

using Mark = Session::Mark;

[[noreturn]] void reject_number(const Element& element, double value, const std::string& right,
                                const Limit& limit = limits::kOther) {
  const std::string unit = *limit.unit == '\0' ? "" : std::string(" ") + limit.unit;
  throw Error(element.source,
              "<" + element.name + "> is " + number_text(value) + unit + "; " + right);
}

void check_number(const Element& element, double value, const Range& range) {
  const bool positive = range.sign == Range::Sign::kPositive;
  if (positive && !(value > 0.0)) reject_number(element, value, "it must be greater than 0");
  if (range.sign == Range::Sign::kNotNegative && value < 0.0) {
    reject_number(element, value, "it must not be negative");
  }
  if (range.usable) return;
  const std::string problem = limit_problem(range.limit, value, positive);
  if (!problem.empty()) reject_number(element, value, problem, range.limit);
}

// A shape without thickness is as thin as Gazebo makes it, as a plate of 0.3 0.2 0 m.
void set_minimum_thickness(const Element& element, std::vector<double>& values, Session& session) {
  constexpr double kThin = 1e-4;  // m
  if (!is_in(0.0, values)) return;
  if (!session.dialect->corrects_values()) return;
  std::replace(values.begin(), values.end(), 0.0, kThin);
  session.warn(element.source,
               "<" + element.name + "> is 0; it must be greater than 0; it is taken as 0.1 mm");
}

double usable(const Element& element, double value, const Range& range, Session& session) {
  if (!range.usable || value == 0.0) return value;
  const double kept = std::clamp(value, range.usable->first, range.usable->second);
  if (kept == value) return value;
  session.warn(element.source, "<" + element.name + "> is " + number_text(value) +
                                   "; it is taken as " + number_text(kept) +
                                   (kept < value ? ", the most" : ", the least") +
                                   " that the solver can use");
  return kept;
}

std::vector<double> numbers_in_range(const Element& element, std::size_t count, const Range& range,
                                     Session& session) {
  std::vector<double> values = numbers_of(element, count);
  if (range.thickness) set_minimum_thickness(element, values, session);
  for (double& value : values) {
    check_number(element, value, range);
    value = usable(element, value, range, session);
  }
  return values;
}

}  // namespace

Reader::Reader(const Element* element, Session& session) : element_(element), session_(&session) {
  if (element_ != nullptr) session.read.emplace(element_, Mark::kRead);
}

const Element* Reader::child(const std::string& key) const {
  const Element* found = element_ == nullptr ? nullptr : element_->child(key);
  if (found != nullptr) session_->read.emplace(found, mark_);
  return found;
}

const Element& Reader::need(const std::string& key) const {
  if (const Element* found = child(key)) return *found;
  for (const Element& other : element_->children) {
    if (meant_element(other.name, element_->name) == key) {
      throw Error(other.source, unknown_element(other.name, element_->name));
    }
  }
  throw Error(element_->source, "<" + element_->name + "> has no <" + key + ">; give it one");
}

double Reader::need_number(const std::string& key, const Range& range) const {
  need(key);
  return number(key, 0.0, range);
}

Vec3 Reader::need_vector(const std::string& key, const Range& range) const {
  need(key);
  return vector(key, Vec3::Zero(), range);
}

const std::string* Reader::attribute(const std::string& key) const {
  const std::string* found = element_ == nullptr ? nullptr : element_->attribute(key);
  if (found != nullptr) session_->read_attributes.emplace(element_, key);
  return found;
}

std::optional<double> Reader::number(const std::string& key, const Range& range) const {
  const Element* found = child(key);
  if (found == nullptr) return std::nullopt;
  return numbers_in_range(*found, 1, range, *session_)[0];
}

double Reader::number(const std::string& key, double fallback, const Range& range) const {
  return number(key, range).value_or(fallback);
}

std::vector<double> Reader::numbers(const std::string& key, std::size_t count,
                                    const Range& range) const {
  const Element* found = child(key);
  if (found == nullptr) return {};
  return numbers_in_range(*found, count, range, *session_);
}

Vec3 Reader::vector(const std::string& key, const Vec3& fallback, const Range& range) const {
  const std::vector<double> v = numbers(key, 3, range);
  return v.empty() ? fallback : Vec3(v[0], v[1], v[2]);
}

Vec3 Reader::direction(const std::string& key, const Vec3& fallback) const {
  const Vec3 v = vector(key, fallback, Range::any(limits::kDirection));
  const double length = std::sqrt(v.x() * v.x() + v.y() * v.y() + v.z() * v.z());
  if (v != Vec3::Zero() && length < limits::kDirection.least) {
    throw Error(child(key)->source, "<" + key + "> has length " + number_text(length) +
                                        "; give a direction such as 0 0 1");
  }
  return v;
}

std::optional<Eigen::Vector4f> Reader::color(const std::string& key) const {
  const Element* found = child(key);
  if (found == nullptr) return std::nullopt;
  const std::size_t count = std::clamp<std::size_t>(numbers_in(found->text).values.size(), 3, 4);
  const Range range = Range::not_negative(limits::kColor);
  const std::vector<double> v = numbers_in_range(*found, count, range, *session_);
  Eigen::Vector4f color(0.0F, 0.0F, 0.0F, 1.0F);
  for (std::size_t i = 0; i < v.size(); ++i) {
    color[static_cast<Eigen::Index>(i)] = static_cast<float>(std::min(v[i], 1.0));
  }
  return color;
}

bool Reader::flag(const std::string& key, bool fallback) const {
  const Element* found = child(key);
  return found == nullptr ? fallback : flag_of(*found);
}

std::string Reader::text(const std::string& key) const {
  const Element* found = child(key);
  return found == nullptr ? "" : found->text;
}

void Reader::note(std::initializer_list<const char*> keys) const {
  if (element_ == nullptr) return;
  for (const Element& each : element_->children) {
    for (const char* key : keys) {
      if (each.name == key) session_->read.emplace(&each, Mark::kRead);
    }
  }
}

void Reader::leave_to_others() const { session_->read[element_] = Mark::kOpen; }

Reader Reader::unused() const {
  Reader copy = *this;
  copy.mark_ = Mark::kUnused;
  return copy;
}

namespace {

void note_attributes(const Element& element, Session& session) {
  static const std::set<std::string> of_pose = {"relative_to", "degrees", "rotation_format"};
  for (const auto& [name, value] : element.attributes) {
    if (name == "name" || name == kStrict || name.rfind("xmlns", 0) == 0) continue;
    if (element.name == "pose" && of_pose.count(name) != 0) continue;
    if (session.read_attributes.count({&element, name}) != 0) continue;
    session.ignore(element.source, name + "=\"" + value + "\" of <" + element.name + ">");
  }
}

void walk(const Element& element, Mark mark, Session& session) {
  if (mark != Mark::kOpen) note_attributes(element, session);
  for (const Element& child : element.children) {
    const auto found = session.read.find(&child);
    const bool known = found != session.read.end();
    const Mark its = known ? found->second : child.name == "pose" ? Mark::kRead : Mark::kUnused;
    if (its == Mark::kUnused) {
      const std::string unknown = known ? "" : unknown_element(child.name, element.name);
      if (!unknown.empty() && meant_element(child.name, element.name).empty()) {
        session.warn(child.source, unknown);
      } else if (!unknown.empty()) {
        session.warn_or_throw(Error(child.source, unknown));
      } else if (known || mark != Mark::kOpen) {
        session.ignore(child.source, "<" + child.name + "> in <" + element.name + ">");
      } else if (child.name != "plugin") {
        walk(child, mark, session);
      }
    } else if (its != Mark::kWarned && child.name != "plugin") {  // its kind lists its own
      walk(child, its, session);
    }
  }
}

}  // namespace

void note_ignored(const Element& element, Session& session) {
  walk(element, Mark::kRead, session);
  session.forget(element);
}

}  // namespace angen::load
