#include "ros/by_name.h"

#include <sstream>

namespace angen::node {

// Constants have an `=`; after a line of `=` follow the definitions of other messages.
std::vector<std::string> field_names(const std::string& definition) {
  std::vector<std::string> names;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line) && line.rfind("==", 0) != 0;) {
    const std::string declared = line.substr(0, line.find('#'));
    std::istringstream words(declared);
    std::string type, name;
    if (declared.find('=') == std::string::npos && words >> type >> name) names.push_back(name);
  }
  return names;
}

}  // namespace angen::node
