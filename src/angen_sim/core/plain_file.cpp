#include "core/plain_file.h"

#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <algorithm>
#include <array>

namespace angen {
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
  return std::find(kOfTheKernel.begin(), kOfTheKernel.end(), type) == kOfTheKernel.end();
}

}  // namespace angen
