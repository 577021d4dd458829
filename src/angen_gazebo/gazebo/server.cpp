#include "gazebo/server.h"

#include <ros/console.h>

#include <cctype>

#include "core/text.h"

namespace angen::node::gazebo {

namespace {

constexpr std::size_t kLongestStatus = 10'000;  // bytes

}  // namespace

std::string Server::name_of(const std::string& title) {
  std::string name;
  for (const char c : title) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0 && !name.empty()) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

std::string Server::status_of(const std::string& title, const std::exception& problem) {
  std::string status = title + ": " + problem.what();
  if (const auto* failed = dynamic_cast<const Failed*>(&problem)) status = failed->what();
  status = shortened(status, kLongestStatus);
  ROS_WARN("%s", printable(status, kLongestStatus).c_str());
  const auto* missing = dynamic_cast<const NotFound*>(&problem);
  return missing == nullptr ? status : title + ": " + missing->text();
}

}  // namespace angen::node::gazebo
