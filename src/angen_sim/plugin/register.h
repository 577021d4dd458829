#pragma once

// Included by the .cpp of a plug-in library only.
#include <class_loader/class_loader.hpp>
#include <memory>
#include <string>

#include "plugin/plugin.h"

/// Puts a Plugin subclass into the library's list.
#define ANGEN_REGISTER_PLUGIN(Type) CLASS_LOADER_REGISTER_CLASS(Type, angen::Plugin)

/// A sensor class and its kind, with no Plugin subclass to write. Stands in the class's namespace.
#define ANGEN_REGISTER_SENSOR(Type, Kind, Doc)                                               \
  struct Type##Plugin : angen::Plugin {                                                      \
    std::string kind() const override { return Kind; }                                       \
    std::string doc() const override { return Doc; }                                         \
    std::unique_ptr<angen::Sensor> make_sensor() const override {                            \
      return std::make_unique<Type>();                                                       \
    }                                                                                        \
  };                                                                                         \
  ANGEN_REGISTER_PLUGIN(Type##Plugin)
