#pragma once

#include "desc/home.h"
#include "sdf/reader.h"

/// Reads the elements of the namespace angen that describe a home: docs/home.md.
namespace angen::load {

/// Whether an element of that name belongs to the description of a home.
bool is_of_home(const std::string& element);

/// Adds the parts of a <world> or <model>; `frame` is the element's frame in that of `to`. Throws
/// Error.
void read_home_parts(const Reader& parent, const Pose& frame, desc::HomeParts& to,
                     Session& session);

/// The <angen:home> of a <world>.
desc::HomeSite home_site_of(const Reader& world, Session& session);

}  // namespace angen::load
