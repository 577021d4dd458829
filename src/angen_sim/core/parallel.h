#pragma once

#include <functional>

namespace angen {

/// Processors that this thread may use.
int processors();

/// Calls work(0) to work(count - 1), in no order, on up to `threads` threads. Each thread makes its
/// own `work` with `worker`, so that caches need no locks; for results that do not depend on the
/// threads, the output of work(i) must depend on i only. The threads end with the call: a process
/// may fork between two calls. An exception of a call is thrown again.
void parallel(int count, int threads, const std::function<std::function<void(int)>()>& worker);

}  // namespace angen
