#include "ros/wire.h"

#include <ros/this_node.h>

#include <cctype>
#include <cstdio>

namespace angen::node {

namespace {

bool is_plain(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool starts_escape(const std::string& text, std::size_t at) {
  const auto is_hex = [&](std::size_t i) {
    return std::isxdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  return text[at] == '_' && at + 3 < text.size() && text[at + 1] == 'x' && is_hex(at + 2) &&
         is_hex(at + 3);
}

std::string escape(char c) {
  char digits[5];
  std::snprintf(digits, sizeof digits, "_x%02x",
                static_cast<unsigned>(static_cast<unsigned char>(c)));
  return digits;
}

}  // namespace

std::string graph_name(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '/') {
      if (out.empty() || out.back() != '/') out += c;
    } else {
      out += is_plain(c) && !starts_escape(text, i) ? std::string(1, c) : escape(c);
    }
  }
  while (out.size() > 1 && out.back() == '/') out.pop_back();
  const bool starts =
      !out.empty() && (std::isalpha(static_cast<unsigned char>(out[0])) != 0 || out[0] == '/');
  return starts ? out : "a" + out;
}

std::string in_namespace(const std::string& name) {
  const std::string& space = ros::this_node::getNamespace();
  return (space == "/" ? "" : space) + (name.rfind('/', 0) == 0 ? "" : "/") + name;
}

std::string default_topic(const std::string& kind, const std::string& name) {
  return in_namespace("angen/" + kind + "/" + name);
}

std::string topic_of(const std::string& kind, const std::string& name,
                     const std::string& requested) {
  return graph_name(requested.empty() ? default_topic(kind, name) : requested);
}

}  // namespace angen::node
