#pragma once

#include <memory>
#include <mutex>
#include <sdf/sdf.hh>
#include <set>
#include <string>

#include "load/expand.h"

/// The only place that calls libsdformat: the schema, and URDF. Frames and poses are worked out by
/// frames.h: libsdformat's graphs of them take time with the square of a model's size.
namespace angen::load {

/// While one lives, nothing that libsdformat or urdfdom say reaches the console; it is kept
/// instead. Their streams are global: one holder at a time, others wait.
class Hush {
 public:
  Hush();
  ~Hush();
  Hush(const Hush&) = delete;
  Hush& operator=(const Hush&) = delete;

  std::string messages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws the first error that libsdformat's schema finds in a <world> element of SDF 1.9 that has
/// passed the checks, as Error at the place the element came from; unknown elements are warnings.
void check_schema(const Element& world, Session& session);

/// Adds the names of an element and of all below it.
void collect_names(const Element& element, std::set<std::string>& names);

/// The schema with what is required or has one of `names`, and nothing else. Under Hush's lock.
sdf::SDFPtr empty_document(const std::set<std::string>& names);

}  // namespace angen::load
