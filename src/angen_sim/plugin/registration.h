#pragma once

// Included by the .cpp of a plug-in library only.
#include <class_loader/class_loader.hpp>
#include <memory>
#include <string>

#include "plugin/plugin.h"

/// Puts a Plugin subclass into the library's list. The name that class_loader keeps it under holds
/// the file's too: two libraries may have classes of the same name.
#define ANGEN_REGISTER_PLUGIN(Type) ANGEN_REGISTER_PLUGIN_HOP(Type, __COUNTER__)
#define ANGEN_REGISTER_PLUGIN_HOP(Type, Number) ANGEN_REGISTER_PLUGIN_AS(Type, Number)
#define ANGEN_REGISTER_PLUGIN_AS(Type, Number)                                       \
  namespace {                                                                        \
  [[maybe_unused]] const auto angen_registration_##Number =                          \
      class_loader::impl::registerPlugin<Type, angen::Plugin>(#Type " in " __FILE__, \
                                                              "angen::Plugin");      \
  }

#define ANGEN_DESCRIBED_AS(...)               \
  const angen::Kind& kind() const override {  \
    using angen::Kind;                        \
    static const Kind described(__VA_ARGS__); \
    return described;                         \
  }

/// A sensor class and its kind, with no Plugin subclass to write: ANGEN_REGISTER_SENSOR(Type, NAME,
/// DOC), or ANGEN_REGISTER_SENSOR(Type, Kind(NAME, DOC).number(…)…). Put it into the class's
/// namespace.
#define ANGEN_REGISTER_SENSOR(Type, ...)                                        \
  struct Type##Plugin : angen::Plugin {                                         \
    ANGEN_DESCRIBED_AS(__VA_ARGS__)                                             \
    std::unique_ptr<angen::Sensor> make_sensor(angen::Params&) const override { \
      return std::make_unique<Type>();                                          \
    }                                                                           \
  };                                                                            \
  ANGEN_REGISTER_PLUGIN(Type##Plugin)

/// Registers a device that any model may have.
#define ANGEN_REGISTER_DEVICE(Type, ...) ANGEN_REGISTER_PART(Type, model.name, __VA_ARGS__)

/// Registers a part that any model may have, and that commands call `model_name`, an expression of
/// the ModelInfo `model`: its main device has the model's own name.
#define ANGEN_REGISTER_PART(Type, model_name, ...)                                                 \
  struct Type##Plugin : angen::Plugin {                                                            \
    ANGEN_DESCRIBED_AS(__VA_ARGS__)                                                                \
    bool serves(const angen::ModelInfo&) const override { return true; }                           \
    std::string instance_name(const angen::ModelInfo& model) const override { return model_name; } \
    std::unique_ptr<angen::Device> make_device() const override {                                  \
      return std::make_unique<Type>();                                                             \
    }                                                                                              \
  };                                                                                               \
  ANGEN_REGISTER_PLUGIN(Type##Plugin)
