#include "node/logger_services.h"

#include <log4cxx/logger.h>
#include <log4cxx/logmanager.h>
#include <ros/console.h>
#include <ros/names.h>
#include <ros/node_handle.h>
#include <ros/service_manager.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/diagnostics.h"
#include "core/text.h"

namespace angen::node {
namespace {

using Level = ros::console::levels::Level;

const std::array<std::pair<const char*, Level>, 5> kLevels = {{{"debug", Level::Debug},
                                                               {"info", Level::Info},
                                                               {"warn", Level::Warn},
                                                               {"error", Level::Error},
                                                               {"fatal", Level::Fatal}}};

Level level_named(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [known, level] : kLevels) {
    if (name == known) return level;
  }
  throw Error("level '" + printable(name) + "', must be debug, info, warn, error or fatal");
}

std::string level_of(const log4cxx::Logger& logger) {
  const int level = logger.getEffectiveLevel()->toInt();
  const char* name = kLevels.front().first;
  constexpr std::array<int, kLevels.size()> kLeast = {
      log4cxx::Level::DEBUG_INT, log4cxx::Level::INFO_INT, log4cxx::Level::WARN_INT,
      log4cxx::Level::ERROR_INT, log4cxx::Level::FATAL_INT};
  for (std::size_t i = 0; i < kLevels.size(); ++i) {
    if (level >= kLeast[i]) name = kLevels[i].first;
  }
  return name;
}

template <class Owner, class Service>
ros::ServiceServer replace(const std::string& name, ros::CallbackQueue& queue, Owner& owner,
                           bool (Owner::*serve)(typename Service::Request&,
                                                typename Service::Response&)) {
  ros::ServiceManager::instance()->unadvertiseService(ros::names::resolve("~" + name));
  ros::NodeHandle node("~");
  node.setCallbackQueue(&queue);
  return node.advertiseService(name, serve, &owner);
}

}  // namespace

LoggerServices::LoggerServices(ros::CallbackQueue& queue)
    : list_(replace<LoggerServices, roscpp::GetLoggers>("get_loggers", queue, *this,
                                                        &LoggerServices::list)),
      set_level_(replace<LoggerServices, roscpp::SetLoggerLevel>("set_logger_level", queue, *this,
                                                                 &LoggerServices::set_level)) {}

bool LoggerServices::list(roscpp::GetLoggers::Request&, roscpp::GetLoggers::Response& response) {
  for (const log4cxx::LoggerPtr& logger : log4cxx::LogManager::getCurrentLoggers()) {
    roscpp::Logger& entry = response.loggers.emplace_back();
    entry.name = logger->getName();
    entry.level = level_of(*logger);
  }
  return true;
}

/// roscpp answers a client with the text of an exception.
bool LoggerServices::set_level(roscpp::SetLoggerLevel::Request& request,
                               roscpp::SetLoggerLevel::Response&) {
  const Level level = level_named(request.level);
  if (log4cxx::LogManager::exists(request.logger) == nullptr) {
    throw Error("no logger '" + printable(request.logger) + "'; get_loggers lists all");
  }
  ros::console::set_logger_level(request.logger, level);
  ros::console::notifyLoggerLevelsChanged();
  return true;
}

}  // namespace angen::node
