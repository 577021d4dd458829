#pragma once

namespace angen {

/// Whether documents may name files and plug-in libraries anywhere: ANGEN_ALLOW_PATHS is true or 1.
bool allow_paths();

}  // namespace angen
