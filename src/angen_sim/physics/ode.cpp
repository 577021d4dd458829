#include "physics/ode.h"

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace angen::physics::ode {

namespace {

thread_local bool lcp_failed = false;

void on_message(int number, const char* text, va_list arguments) {
  if (number == d_ERR_LCP) {
    lcp_failed = true;
    return;
  }
  static std::atomic<bool> reported{false};
  char line[200];
  std::vsnprintf(line, sizeof line, text, arguments);
  if (std::strstr(line, "hash table") != nullptr) {  // printed for each pair in each step
    if (reported.exchange(true)) return;
    std::fputs(
        "physics: meshes overlap at more places than ODE distinguishes: some of their contacts "
        "may be duplicated (reported once)\n",
        stderr);
    return;
  }
  std::fprintf(stderr, "ODE: %s\n", line);
}

// ODE would abort() or exit() after it.
void on_failure(int, const char* text, va_list arguments) {
  char line[200];
  std::vsnprintf(line, sizeof line, text, arguments);
  throw Failure(line);
}

bool start() {
  dInitODE2(0);
  dSetMessageHandler(on_message);
  dSetErrorHandler(on_failure);
  dSetDebugHandler(on_failure);
  return true;
}

}  // namespace

void prepare_thread() {
  static const bool started = start();
  static_cast<void>(started);
  thread_local const int allocated = dAllocateODEDataForThread(dAllocateMaskAll);
  static_cast<void>(allocated);
}

bool take_lcp_failure() {
  const bool failed = lcp_failed;
  lcp_failed = false;
  return failed;
}

std::size_t collide(dGeomID a, dGeomID b, std::size_t most, dContactGeom* points) {
  try {
    return static_cast<std::size_t>(
        dCollide(a, b, static_cast<int>(most), points, sizeof(dContactGeom)));
  } catch (const Failure&) {
    return 0;
  }
}

}  // namespace angen::physics::ode
