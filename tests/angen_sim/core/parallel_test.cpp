#include "core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace angen {
namespace {

TEST(Parallel, EachPartIsDoneOnceWhateverTheNumberOfThreads) {
  for (const int threads : {-1, 0, 1, 2, 3, 16, 1000}) {
    for (const int count : {0, 1, 2, 97}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      std::atomic<int> workers{0};
      parallel(count, threads, [&] {
        ++workers;
        return [&](int part) { ++done[static_cast<std::size_t>(part)]; };
      });
      for (const std::atomic<int>& each : done) EXPECT_EQ(each, 1);
      EXPECT_LE(workers, std::max(1, std::min(threads, count)));
    }
  }
}

TEST(Parallel, ThrowsWhatAPartThrows) {
  for (const int threads : {1, 4}) {
    EXPECT_THROW(parallel(50, threads,
                          [] {
                            return [](int part) {
                              if (part == 31) throw std::out_of_range("31");
                            };
                          }),
                 std::out_of_range);
  }
}

TEST(Parallel, ThereIsAProcessor) { EXPECT_GE(processors(), 1); }

}  // namespace
}  // namespace angen
