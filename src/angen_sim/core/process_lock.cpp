#include "core/process_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/diagnostics.h"
#include "core/random.h"

namespace angen {

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
