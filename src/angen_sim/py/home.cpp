#include <cmath>

#include "core/home_fields.h"
#include "py/bindings.h"

namespace angen::py {

namespace {

namespace pyb = pybind11;

pyb::object to_py(const std::string& text) { return pyb::str(text); }
pyb::object to_py(bool flag) { return pyb::bool_(flag); }
pyb::object to_py(int number) { return pyb::int_(number); }
pyb::object to_py(double number) {
  return std::isnan(number) ? pyb::object(pyb::none()) : pyb::float_(number);
}

pyb::list numbers(std::initializer_list<double> all) {
  pyb::list list;
  for (const double each : all) list.append(each);
  return list;
}

pyb::object to_py(const Point2& point) { return numbers({point.x(), point.y()}); }
pyb::object to_py(const FloorPose& pose) {
  return numbers({pose.position.x(), pose.position.y(), pose.position.z(), pose.yaw});
}
pyb::object to_py(const Pose& pose) {
  const Quat& q = pose.rotation;
  return numbers(
      {pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()});
}

template <class Part>
pyb::dict dict_of(const Part& part);

template <class Part>
auto to_py(const Part& part) -> decltype(visit_fields(part, 0), pyb::object()) {
  return dict_of(part);
}

template <class Each>
pyb::object to_py(const std::vector<Each>& all) {
  pyb::list list;
  for (const Each& each : all) list.append(to_py(each));
  return list;
}

pyb::object to_py(const std::string (&pair)[2]) {
  return to_py(std::vector<std::string>{pair[0], pair[1]});
}

template <class Part>
pyb::dict dict_of(const Part& part) {
  pyb::dict dict;
  visit_fields(
      part, [&](const char* name, const auto& value, const auto&) { dict[name] = to_py(value); });
  return dict;
}

}  // namespace

pyb::dict home_dict(const Home& home) { return dict_of(home); }

}  // namespace angen::py
