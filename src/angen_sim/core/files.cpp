#include "core/files.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/diagnostics.h"
#include "core/lists.h"
#include "core/random.h"

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

bool write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = ENOSPC;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

namespace {

constexpr std::array<unsigned long, 10> kOfTheKernel = {
    PROC_SUPER_MAGIC,   SYSFS_MAGIC,         DEBUGFS_MAGIC, TRACEFS_MAGIC,  SECURITYFS_MAGIC,
    CGROUP_SUPER_MAGIC, CGROUP2_SUPER_MAGIC, BPF_FS_MAGIC,  PSTOREFS_MAGIC, EFIVARFS_MAGIC};

}  // namespace

bool is_plain_file(const std::string& path) {
  struct stat found {};
  struct statfs system {};
  if (stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return false;
  if (statfs(path.c_str(), &system) != 0) return false;
  const auto type = static_cast<unsigned long>(system.f_type) & 0xffffffffUL;
  return !is_in(type, kOfTheKernel);
}

bool lock_until_exit(const std::string& path, const std::string& key) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
  struct flock place {};
  place.l_type = F_WRLCK;
  place.l_whence = SEEK_SET;
  place.l_start = static_cast<off_t>(hash_bytes(key) >> 2);  // the last byte of a file is 2^63 - 1
  place.l_len = 1;
  // A lock of the open file, which stays open: the kernel releases it at the end of the process.
  if (file >= 0 && fcntl(file, F_OFD_SETLK, &place) == 0) return true;
  const int problem = errno;
  if (file >= 0) close(file);
  if (file >= 0 && (problem == EAGAIN || problem == EACCES)) return false;
  throw Error(path + ": " + std::strerror(problem));
}

}  // namespace angen
