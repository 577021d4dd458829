#pragma once

#include <pybind11/pybind11.h>

#include "core/diagnostics.h"

namespace angen::py {

/// What one call at a time may use: a call that runs plug-ins or lets other threads go on is in
/// progress as long as a Busy exists. Read and changed with the GIL held.
class Exclusive {
 public:
  class Busy {
   public:
    /// Throws Error if another call is in progress.
    explicit Busy(const Exclusive& used) : used_(used) {
      used.require_idle();
      used.is_busy_ = true;
    }
    ~Busy() { used_.is_busy_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

   private:
    const Exclusive& used_;
  };

  /// Throws Error if another call is in progress.
  void require_idle() const {
    if (is_busy_) {
      throw Error(
          "a call is in progress, in another thread or around this plug-in; use it after that");
    }
  }

 private:
  mutable bool is_busy_ = false;
};

/// Whether a Python object of T has been made by its class, and not by __new__ alone.
template <class T>
bool is_made(pybind11::handle object) {
  if (!pybind11::isinstance<T>(object)) return true;  // None, or of another type
  auto* instance = reinterpret_cast<pybind11::detail::instance*>(object.ptr());
  return instance->get_value_and_holder().value_ptr() != nullptr;
}

/// Converts arguments to T, an Exclusive.
template <class T>
class ExclusiveCaster : public pybind11::detail::type_caster_base<T> {
 public:
  bool load(pybind11::handle source, bool convert) {
    if (!is_made<T>(source) || !pybind11::detail::type_caster_base<T>::load(source, convert)) {
      return false;
    }
    if (this->value != nullptr) static_cast<const T*>(this->value)->require_idle();
    return true;
  }
};

}  // namespace angen::py
