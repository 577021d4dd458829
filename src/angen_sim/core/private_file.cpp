#include "core/private_file.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/diagnostics.h"
#include "core/write_all.h"

namespace angen {
namespace {

[[noreturn]] void fail_at(const std::string& path, int problem) {
  throw Error(path + ": " + std::strerror(problem));
}

// A relative path is ignored, as the XDG specification says.
std::string absolute_variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr || *value != '/' ? "" : value;
}

std::string home() {
  const std::string given = absolute_variable("HOME");
  if (!given.empty()) return given;
  const passwd* entry = getpwuid(geteuid());
  if (entry == nullptr) throw Error("there is no home folder: set HOME");
  return entry->pw_dir;
}

void make_folders(const std::string& folder) {
  for (std::size_t end = folder.find('/', 1);; end = folder.find('/', end + 1)) {
    const std::string part = folder.substr(0, end);
    if (mkdir(part.c_str(), 0700) != 0 && errno != EEXIST) fail_at(part, errno);
    if (end == std::string::npos) return;
  }
}

}  // namespace

std::string state_folder() {
  const std::string given = absolute_variable("XDG_STATE_HOME");
  return (given.empty() ? home() + "/.local/state" : given) + "/angen";
}

void make_private_folder(const std::string& folder) {
  make_folders(folder);
  const int found = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat state {};
  const bool own = found >= 0 && fstat(found, &state) == 0 && state.st_uid == geteuid();
  const bool closed_to_others = own && ((state.st_mode & 077U) == 0 || fchmod(found, 0700) == 0);
  if (found >= 0) close(found);
  if (!closed_to_others) throw Error(folder + ": is not a folder of this user's, remove it");
}

void write_private_file(const std::string& path, const std::string& bytes) {
  static std::atomic<int> count{0};
  const std::string fresh = path + "." + std::to_string(getpid()) + "." + std::to_string(++count);
  unlink(fresh.c_str());  // an earlier process of this number left it
  const int file = open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) fail_at(path, errno);
  int problem = write_all(file, bytes) && fsync(file) == 0 ? 0 : errno;
  if (close(file) != 0 && problem == 0) problem = errno;
  if (problem == 0 && rename(fresh.c_str(), path.c_str()) != 0) problem = errno;
  if (problem == 0) return;
  unlink(fresh.c_str());
  fail_at(path, problem);
}

}  // namespace angen
