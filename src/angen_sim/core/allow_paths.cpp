#include "core/allow_paths.h"

#include <cstdlib>
#include <string>

namespace angen {

bool allow_paths() {
  const char* value = std::getenv("ANGEN_ALLOW_PATHS");
  const std::string text = value == nullptr ? "" : value;
  return text == "true" || text == "True" || text == "1";
}

}  // namespace angen
