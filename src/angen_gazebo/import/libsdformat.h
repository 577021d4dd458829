#pragma once

#include <memory>
#include <sdf/sdf.hh>
#include <set>
#include <string>

#include "core/element.h"

/// Calls of libsdformat: for its schema, and for URDF.
namespace angen::load {

/// While one lives, nothing that libsdformat or urdfdom say reaches the console; it is kept
/// instead. Their streams are global: one holder at a time, others wait.
class SilenceConsole {
 public:
  SilenceConsole();
  ~SilenceConsole();
  SilenceConsole(const SilenceConsole&) = delete;
  SilenceConsole& operator=(const SilenceConsole&) = delete;

  std::string messages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Adds the names of an element and of all below it.
void collect_names(const Element& element, std::set<std::string>& names);

/// The schema with the required elements and those of `names`, and no others. Under a
/// SilenceConsole's lock.
sdf::SDFPtr empty_document(const std::set<std::string>& names);

}  // namespace angen::load
