#pragma once

#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/element.h"
#include "core/limits.h"
#include "core/pose.h"
#include "document/session.h"

namespace angen::load {

/// The range that a number must be in; it must also be finite.
struct Range {
  enum class Sign { kAny, kPositive, kNotNegative };

  Sign sign = Sign::kAny;
  Limit limit = limits::kOther;
  /// Beyond these the solver sees no difference, so the bound is used, with a warning. 0 stays 0.
  std::optional<std::pair<double, double>> usable{};
  bool thickness = false;  // 0 may be corrected to 0.1 mm

  static constexpr Range any(const Limit& limit) { return {Sign::kAny, limit}; }
  static constexpr Range positive(const Limit& limit = limits::kOther) {
    return {Sign::kPositive, limit};
  }
  static constexpr Range not_negative(const Limit& limit = limits::kOther) {
    return {Sign::kNotNegative, limit};
  }
  static constexpr Range solver(double low, double high, Sign sign = Sign::kNotNegative) {
    return {sign, limits::kOther, std::pair{low, high}};
  }
  /// The size of a shape.
  static constexpr Range size() { return {Sign::kPositive, limits::kLength, std::nullopt, true}; }
};

constexpr Limit kFinite{"", std::numeric_limits<double>::max(), 0.0};

/// Reads the children and attributes of one element, checks them, and notes in the session that
/// they are read: note_ignored() lists the rest. A wrong value throws Error with file and line. A
/// reader of an element that does not exist returns the fallbacks.
class Reader {
 public:
  Reader(const Element& element, Session& session) : Reader(&element, session) {}

  explicit operator bool() const { return element_ != nullptr; }
  const Element& element() const { return *element_; }

  /// The first child of that name, null if there is none.
  const Element* child(const std::string& key) const;
  Reader block(const std::string& key) const { return {child(key), *session_}; }
  /// A child that must be there.
  const Element& need(const std::string& key) const;
  double need_number(const std::string& key, const Range& range) const;
  Vec3 need_vector(const std::string& key, const Range& range) const;
  const std::string* attribute(const std::string& key) const;

  double number(const std::string& key, double fallback, const Range& range = {}) const;
  std::optional<double> number(const std::string& key, const Range& range = {}) const;
  /// `count` numbers, none if there is no such child.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Range& range) const;
  Vec3 vector(const std::string& key, const Vec3& fallback, const Range& range) const;
  /// A vector that is to be normalized; 0 0 0 is left to the caller.
  Vec3 direction(const std::string& key, const Vec3& fallback) const;
  /// r g b or r g b a, each cut to 0..1; alpha 1 when it is not given.
  std::optional<Eigen::Vector4f> color(const std::string& key) const;
  bool flag(const std::string& key, bool fallback) const;
  std::string text(const std::string& key) const;

  /// All children of these names are read by others.
  void note(std::initializer_list<const char*> keys) const;
  /// Others may read any of its attributes and children.
  void leave_to_others() const;
  /// Checks the element, and notes it as without effect.
  Reader unused() const;

 private:
  Reader(const Element* element, Session& session);

  const Element* element_;
  Session* session_;
  Session::Mark mark_ = Session::Mark::kRead;  // mark of its children
};

/// Notes in the session the unread parts of an element and of all read ones below: elements and
/// attributes, each once for its place. A <pose>, a name and the contents of a <plugin> count as
/// read.
void note_ignored(const Element& element, Session& session);

/// The element of SDF that an unknown one in `parent` most likely was to be: "waypoint" for
/// "waypont" in "trajectory". Empty if SDF has the element there, or none that is so near.
std::string meant_element(const std::string& name, const std::string& parent);

/// Why an element that nothing reads is wrong: "<waypont> in <trajectory> is not known; did you
/// mean <waypoint>?". Empty if SDF has it there, or if Angen uses nothing of `parent`.
std::string unknown_element(const std::string& name, const std::string& parent);

}  // namespace angen::load
