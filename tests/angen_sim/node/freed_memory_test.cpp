#include "node/freed_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <vector>

namespace angen::node {
namespace {

constexpr std::size_t kCloud = 640 * 480 * 32;  // bytes, of a depth camera's points
constexpr long kPages = kCloud / 4096;

/// Faults of pages while a message and its serialized copy are made and freed.
long faults_of_a_message() {
  rusage before{}, after{};
  getrusage(RUSAGE_THREAD, &before);
  {
    const std::vector<std::uint8_t> message(kCloud, 1);
    const std::vector<std::uint8_t> serialized = message;
    EXPECT_EQ(serialized.back(), 1);
  }
  getrusage(RUSAGE_THREAD, &after);
  return after.ru_minflt - before.ru_minflt;
}

TEST(FreedMemory, IsThereForTheNextMessageIfItIsKept) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "this allocator has no such limits";
#endif
  keep_freed_memory(true);
  faults_of_a_message();
  EXPECT_LT(faults_of_a_message(), kPages / 10);
  keep_freed_memory(false);
  faults_of_a_message();
  EXPECT_GT(faults_of_a_message(), kPages / 600);  // huge pages have 512 of them
  keep_freed_memory(true);
  faults_of_a_message();
  EXPECT_LT(faults_of_a_message(), kPages / 600);
}

}  // namespace
}  // namespace angen::node
