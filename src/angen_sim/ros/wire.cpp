#include "ros/wire.h"

#include <cctype>

namespace angen::node {

std::string graph_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool keep = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/';
    if (c == '/' && !out.empty() && out.back() == '/') continue;
    out += keep ? c : '_';
  }
  while (out.size() > 1 && out.back() == '/') out.pop_back();
  const bool starts =
      !out.empty() && (std::isalpha(static_cast<unsigned char>(out[0])) != 0 || out[0] == '/');
  return starts ? out : "a" + out;
}

std::string topic_of(const std::string& kind, const std::string& name, const std::string& asked) {
  return graph_name(asked.empty() ? "/angen/" + kind + "/" + name : asked);
}

}  // namespace angen::node
