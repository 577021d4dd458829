#include "node/rescue.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/diagnostics.h"
#include "core/write_all.h"
#include "record/world_file.h"

namespace angen::node {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw Error("the world cannot be saved in " + path + ": " + std::strerror(errno));
}

// In /tmp anybody may have made a folder, or a link, of that name before.
void make_folder(const std::string& folder) {
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) fail(folder);
  struct stat found {};
  if (lstat(folder.c_str(), &found) != 0) fail(folder);
  if (!S_ISDIR(found.st_mode) || found.st_uid != geteuid()) {
    throw Error("the world cannot be saved: " + folder + " is not a folder of this user's");
  }
}

}  // namespace

std::string default_rescue_path() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const std::string where = runtime == nullptr || *runtime == '\0' ? "/tmp" : runtime;
  return where + "/angen-" + std::to_string(geteuid()) + "/rescue.world";
}

void rescue(sim::Simulation& simulation, const std::string& path) {
  const std::string text = record::world_file(simulation.world(), simulation.saved());
  if (path == default_rescue_path()) make_folder(path.substr(0, path.rfind('/')));
  const std::string fresh = path + "." + std::to_string(getpid());
  unlink(fresh.c_str());
  const int file = open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) fail(path);
  const bool written = write_all(file, text) && fsync(file) == 0;
  const bool closed = close(file) == 0;
  if (written && closed && rename(fresh.c_str(), path.c_str()) == 0) return;
  const int problem = errno;
  unlink(fresh.c_str());
  errno = problem;
  fail(path);
}

}  // namespace angen::node
