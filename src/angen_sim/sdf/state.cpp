#include <algorithm>

#include "core/limits.h"
#include "core/text.h"
#include "document/values.h"
#include "document/xml.h"
#include "sdf/describe.h"

namespace angen::load {

namespace {

template <class T>
T& find_named(std::vector<T>& all, const Element& element, const std::string& where) {
  const std::string name = name_of(element);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const T& item) { return item.name == name; });
  if (found != all.end()) return *found;
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const T& item : all) known.push_back(item.name);
  throw Error(element.source, "<state> names an unknown " + element.name + " '" + name + "'" +
                                  where + "; known are " + join_names(known));
}

void apply_joint(const Element& element, desc::Joint& joint, Session& session) {
  Reader(element, session);
  for (const Element& angle : element.children) {
    if (angle.name != "angle") continue;
    const std::string* text = Reader(angle, session).attribute("axis");
    const std::size_t axis = text == nullptr || *text == "0" ? 0 : *text == "1" ? 1 : 2;
    if (axis >= joint.axes.size()) {
      throw Error(angle.source, tag_of(element) + " has " + std::to_string(joint.axes.size()) +
                                    " axes; there is no axis " + (text == nullptr ? "0" : *text));
    }
    const double position = number_of(angle);
    desc::JointAxis& to = joint.axes[axis];
    const std::string wrong = limit_problem(limits::kPosition, position);
    if (!wrong.empty()) {
      throw Error(angle.source, "the position of " + tag_of(element) + " is " +
                                    number_text(position) + "; " + wrong);
    }
    constexpr double kSlack = 1e-3;  // a joint at its stop may stand a little beyond it
    if (position < to.lower - kSlack || position > to.upper + kSlack) {
      throw Error(angle.source, "the position " + number_text(position) + " of " + tag_of(element) +
                                    " is outside its limits " + number_text(to.lower) + " … " +
                                    number_text(to.upper));
    }
    to.initial_position = position;
  }
}

void apply_model(const Element& element, desc::World& world, Session& session) {
  const Reader reader(element, session);
  desc::Model& model = find_named(world.models, element, "");
  if (const Element* pose = element.child("pose")) model.pose = pose_of(*pose);
  for (const Element& part : element.children) {
    if (part.name == "joint") {
      apply_joint(part, find_named(model.joints, part, " of model '" + model.name + "'"), session);
    }
  }
}

}  // namespace

void apply_state(const Element& state, desc::World& world, Session& session) {
  Reader(state, session).attribute("world_name");
  for (const Element& element : state.children) {
    if (element.name != "model") continue;
    try {
      apply_model(element, world, session);
    } catch (const Error& error) {
      session.warn_or_throw(error);
    }
  }
}

}  // namespace angen::load
