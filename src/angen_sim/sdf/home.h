#pragma once

#include "desc/home.h"
#include "sdf/reader.h"

/// What worlds and models say of a home, in elements of the namespace angen: docs/home.md.
namespace angen::load {

/// Whether an element of that name belongs to the description of a home.
bool is_of_home(const std::string& element);

/// Adds what a <world> or <model> says; `frame` is the element's frame in that of `to`. Throws
/// Error.
void read_home_parts(const Reader& parent, const Pose& frame, desc::HomeParts& to,
                     Session& session);

/// The <angen:home> of a <world>.
desc::HomeSite home_site_of(const Reader& world, Session& session);

}  // namespace angen::load
