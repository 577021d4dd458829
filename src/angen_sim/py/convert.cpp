#include "py/convert.h"

#include "core/diagnostics.h"

namespace angen::py {

namespace {

template <class T>
pyb::object to_object(const T& value) {
  return pyb::cast(value);
}

pyb::object to_object(const Choice& choice) { return pyb::str(choice.name); }

// (height, width), or (height, width, channels) where there are several.
template <class T>
pyb::object to_object(const ImageArray<T>& grid) {
  std::vector<pyb::ssize_t> shape{grid.height, grid.width};
  if (grid.channels != 1) shape.push_back(grid.channels);
  return pyb::array_t<T>(shape, grid.values ? grid.values->data() : nullptr);
}

}  // namespace

pyb::dict to_dict(const Reading& reading) {
  pyb::dict all;
  all["kind"] = reading.kind;
  all["stamp"] = to_seconds(reading.stamp);
  for (const auto& [name, value] : reading.fields) {
    all[pyb::str(name)] = std::visit([](const auto& v) { return to_object(v); }, value);
  }
  return all;
}

namespace {

std::int64_t whole(const std::string& name, const pyb::handle& value) {
  try {
    return pyb::cast<std::int64_t>(value);
  } catch (const pyb::cast_error&) {
    throw Error("the field '" + name + "' is a whole number of more than 64 bits");
  }
}

// A list of texts or of numbers.
void set_list(const std::string& name, const pyb::handle& value, Reading& reading) {
  try {
    const bool texts = pyb::isinstance<pyb::sequence>(value) && pyb::len(value) > 0 &&
                       pyb::isinstance<pyb::str>(value[pyb::int_(0)]);
    const bool empty = pyb::isinstance<pyb::sequence>(value) && pyb::len(value) == 0;
    if (empty && reading.get_if<std::vector<std::string>>(name) != nullptr) {
      reading.set(name.c_str(), std::vector<std::string>());  // stays a list of texts
    } else if (texts) {
      reading.set(name.c_str(), pyb::cast<std::vector<std::string>>(value));
    } else {
      reading.set(name.c_str(), pyb::cast<std::vector<double>>(value));
    }
  } catch (const pyb::cast_error&) {
    throw Error("the field '" + name +
                "' is not a bool, number or text, nor a list of numbers or of texts");
  }
}

// A number of numpy's, or its array without dimensions, as Python's own.
pyb::object plain(const pyb::handle& value) {
  const pyb::object dimensions = pyb::getattr(value, "ndim", pyb::none());
  const bool is_one = pyb::isinstance<pyb::int_>(dimensions) && pyb::cast<int>(dimensions) == 0;
  return is_one ? value.attr("item")() : pyb::reinterpret_borrow<pyb::object>(value);
}

}  // namespace

void from_dict(const pyb::dict& values, Reading& reading) {
  for (const auto& [key, given] : values) {
    if (!pyb::isinstance<pyb::str>(key)) {
      throw Error("keys are str; " + pyb::cast<std::string>(pyb::repr(key)) + " is not");
    }
    const auto name = pyb::cast<std::string>(key);
    const pyb::object value = plain(given);
    if (pyb::isinstance<pyb::bool_>(value)) {
      reading.set(name.c_str(), pyb::cast<bool>(value));
    } else if (pyb::isinstance<pyb::int_>(value)) {
      reading.set(name.c_str(), whole(name, value));
    } else if (pyb::isinstance<pyb::float_>(value)) {
      reading.set(name.c_str(), pyb::cast<double>(value));
    } else if (pyb::isinstance<pyb::str>(value)) {
      reading.set(name.c_str(), pyb::cast<std::string>(value));
    } else {
      set_list(name, value, reading);
    }
  }
}

Pose to_pose(const std::vector<double>& xyzrpy) {
  if (xyzrpy.size() != 6) throw Error("a pose has six numbers: x y z roll pitch yaw (m, rad)");
  Pose pose{{xyzrpy[0], xyzrpy[1], xyzrpy[2]}, from_rpy(xyzrpy[3], xyzrpy[4], xyzrpy[5])};
  if (!pose.finite()) throw Error("a pose has six finite numbers");
  return pose;
}

Eigen::Matrix<double, 1, 7> to_row(const Pose& pose) {
  Eigen::Matrix<double, 1, 7> row;
  row << pose.position.transpose(), pose.rotation.coeffs().transpose();
  return row;
}

}  // namespace angen::py
