#include "core/parallel.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <system_error>
#include <vector>

namespace angen {

int processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  return sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? std::max(1, CPU_COUNT(&allowed)) : 1;
}

void parallel(int count, int threads, const std::function<std::function<void(int)>()>& worker) {
  std::atomic<int> next{0};
  const auto share = [&] {
    const std::function<void(int)> work = worker();
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::future<void>> others;  // whose destructors wait
  try {
    for (int i = 1; i < std::min(threads, count); ++i) {
      others.push_back(std::async(std::launch::async, share));
    }
  } catch (const std::system_error&) {  // no more threads: those that run do it all
  }
  share();
  for (std::future<void>& other : others) other.get();
}

}  // namespace angen
