#include "sim/customs.h"

namespace angen::sim {

std::vector<std::string> ignored(const Error& error) {
  std::vector<std::string> texts;
  for (const Diagnostic& each : error.diagnostics()) texts.push_back(each.text() + " (ignored)");
  return texts;
}

std::vector<std::string> set_aside(const Error& error, const desc::Customs& customs) {
  if (!customs.sets_aside) throw Error(error);
  return ignored(error);
}

std::vector<std::string> finish(const Params& params, const desc::Customs& customs) {
  std::vector<std::string> texts;
  if (!customs.sets_aside) params.finish();
  for (const Diagnostic& each : params.unread()) texts.push_back(each.text() + " (ignored)");
  for (const Diagnostic& warning : params.warnings()) texts.push_back(warning.text());
  return texts;
}

}  // namespace angen::sim
