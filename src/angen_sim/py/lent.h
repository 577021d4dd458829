#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <vector>

#include "py/exclusive.h"

namespace angen::py {

/// The objects of T that methods of plug-ins may use now. Changed with the GIL held.
template <class T>
std::vector<const T*>& lent() {
  static std::vector<const T*> all;
  return all;
}

/// An argument of a plug-in's method, which can be used until the method returns.
template <class T>
class Lent {
 public:
  explicit Lent(const T& value) : value_(&value) { lent<T>().push_back(value_); }
  ~Lent() {
    std::vector<const T*>& all = lent<T>();
    all.erase(std::find(all.begin(), all.end(), value_));
  }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
  pybind11::object get() const {
    return pybind11::cast(value_, pybind11::return_value_policy::reference);
  }

 private:
  const T* value_;
};

/// Converts arguments to T, of which only those that are lent now can be used.
template <class T>
class LentCaster : public pybind11::detail::type_caster_base<T> {
 public:
  bool load(pybind11::handle source, bool convert) {
    if (!is_made<T>(source) || !pybind11::detail::type_caster_base<T>::load(source, convert)) {
      return false;
    }
    const std::vector<const T*>& all = lent<T>();
    if (this->value != nullptr && std::count(all.begin(), all.end(), this->value) == 0) {
      throw Error(
          "an argument of a plug-in's method can be used until the method returns; keep "
          "what it tells, not the object");
    }
    return true;
  }
};

}  // namespace angen::py
