#pragma once

#include "physics/model.h"
#include "physics/shapes.h"

namespace angen::physics {

/// Makes bodies, geoms and joints of a model that has no pose yet. Links that fixed joints hold
/// together become one body, so that they never sag; one fixed to the world is static, and so are
/// kinematic links, which nothing but place() moves. Serials count on from `serial`.
/// Throws Error for a model without a valid body.
std::unique_ptr<ModelRecord> build_model(const desc::Model& model, ShapeFactory& shapes,
                                         std::uint64_t& serial);

/// Puts a model's frame at `pose`, its joints at their initial positions and all velocities to
/// zero. ODE has all of it afterwards.
void configure(dWorldID world, ModelRecord& record, const Pose& pose);

}  // namespace angen::physics
